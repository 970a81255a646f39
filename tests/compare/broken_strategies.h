#pragma once
#include <memory>
#include <stdexcept>

#include "bench/strategies.h"
#include "engine/core/errors.h"
#include "engine/strategy/list.h"

namespace firstray::test {

/// `list`, with something wrong.
template <typename Real>
class BrokenStrategy : public Strategy<Real> {
public:
    enum class Fault { throws_on_update, throws_while_searching, misses };

    BrokenStrategy(const Scene& scene, const StrategyOptions& options, Fault fault)
        : list_(make_list<Real>(scene, options)), fault_(fault)
    {
    }
    void update(const Pose& pose) override
    {
        if (fault_ == Fault::throws_on_update && ++updates_ == 2) throw Error(firstray::Fault::limit, "the second update is too much");
        list_->update(pose);
    }
    void closest(RayTile<Real>& rays) const override
    {
        if (fault_ == Fault::throws_while_searching) throw std::runtime_error("cannot search");
        list_->closest(rays);
        for (std::size_t i = 0; fault_ == Fault::misses && i < static_cast<std::size_t>(rays.count); i += 5) {
            rays.primitive[i] = no_primitive;
            rays.t_max[i] = std::numeric_limits<Real>::infinity();
        }
    }
    void occluded(RayTile<Real>& rays) const override { list_->occluded(rays); }
    StructureReport report() const override { return list_->report(); }

private:
    std::unique_ptr<Strategy<Real>> list_;
    Fault fault_;
    int updates_ = 0;
};

template <BrokenStrategy<float>::Fault fault>
std::unique_ptr<Strategy<float>> make_broken(const Scene& scene, const StrategyOptions& options)
{
    return std::make_unique<BrokenStrategy<float>>(scene, options, fault);
}

inline std::unique_ptr<Strategy<float>> refuse_to_be_made(const Scene&, const StrategyOptions&)
{
    throw Error(firstray::Fault::limit, "cannot be made");
}

using BrokenFault = BrokenStrategy<float>::Fault;
inline constexpr StrategyEntry unmakable{"unmakable", "cannot be made", false, &refuse_to_be_made};
inline constexpr StrategyEntry tiring{"tiring", "fails later", false, &make_broken<BrokenFault::throws_on_update>};
inline constexpr StrategyEntry blind{"blind", "cannot search", false,
                                     &make_broken<BrokenFault::throws_while_searching>};
inline constexpr StrategyEntry leaky{"leaky", "misses every fifth", false, &make_broken<BrokenFault::misses>};

}  // namespace firstray::test
