#pragma once
#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

#include "engine/strategy/strategy.h"

namespace firstray {

/// What a ray of a picture is for. Reflected and transmitted rays look alike to a structure: neighbours part ways.
enum class RayKind : std::uint8_t { primary, shadow, secondary };
inline constexpr std::size_t ray_kinds = 3;
const char* name_of(RayKind kind);

template <typename T>
using ByKind = std::array<T, ray_kinds>;
template <typename T>
T& at(ByKind<T>& values, RayKind kind)
{
    return values[static_cast<std::size_t>(kind)];
}
template <typename T>
const T& at(const ByKind<T>& values, RayKind kind)
{
    return values[static_cast<std::size_t>(kind)];
}

/// Which of Strategy's questions was asked.
enum class RayQuery : std::uint8_t { closest, occluded };

/// The rays of one frame as a renderer asked for them, batch by batch, to be asked again of any strategy. Kept in
/// float.
class RecordedRays {
public:
    struct Batch {
        RayKind kind = RayKind::primary;
        RayQuery query = RayQuery::closest;
        RayMask mask = RayMask::all;
        bool common_apex = false;
        glm::vec3 apex{0.0f};
        std::size_t first = 0, count = 0;
    };

    /// most_rays  about how many are kept: beyond it every second batch is dropped, again and again
    explicit RecordedRays(std::size_t most_rays) : most_rays_(most_rays) {}

    template <typename Real>
    void add(RayKind kind, RayQuery query, const RayTile<Real>& tile);

    const std::vector<Batch>& batches() const { return batches_; }
    /// Rays that were asked, kept or not, and those kept.
    std::uint64_t asked(RayKind kind) const { return at(asked_, kind); }
    std::uint64_t kept(RayKind kind) const;
    std::uint64_t kept() const { return rays_.size(); }

    /// Fills a tile with lanes `first`, `first + step`, ... of a batch.
    template <typename Real>
    void load(const Batch& batch, RayTile<Real>& tile, std::size_t first = 0, std::size_t step = 1) const;

private:
    struct Ray {
        glm::vec3 origin, direction;  // origin: only where there is no common apex
        float t_min, t_max;
    };
    void thin();

    std::size_t most_rays_;
    std::uint64_t step_ = 1;  // of the batches of a kind, every step_-th is kept
    ByKind<std::uint64_t> asked_{}, batches_seen_{};
    std::vector<Batch> batches_;
    std::vector<std::uint64_t> number_;  // by batch: how many of its kind came before
    std::vector<Ray> rays_;
};

/// Answers with another strategy's answers and writes down what it is asked. Which kind a ray is of follows from how
/// the renderer asks: primary rays have a common apex and see everything; `occluded`, and `closest` among transmitting
/// primitives alone, are asked for shadows; what is left is secondary.
template <typename Real>
class RayRecorder : public Strategy<Real> {
public:
    /// asked  must outlive the recorder
    explicit RayRecorder(Strategy<Real>& asked) : asked_(asked) {}

    /// Writes down from now on; null: nothing.
    /// rays  must outlive what is recorded
    void record_to(RecordedRays* rays) { rays_ = rays; }

    void update(const Pose& pose) override;
    void closest(RayTile<Real>& tile) const override;
    void occluded(RayTile<Real>& tile) const override;
    StructureReport report() const override { return asked_.report(); }

private:
    void write_down(RayKind kind, RayQuery query, const RayTile<Real>& tile) const;
    bool is_primary(const RayTile<Real>& tile) const;

    Strategy<Real>& asked_;
    typename RayTile<Real>::Vec eye_{0};
    RecordedRays* rays_ = nullptr;
    mutable std::mutex mutex_;
};

}  // namespace firstray
