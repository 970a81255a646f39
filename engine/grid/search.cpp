#include "engine/grid/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/grid/search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/grid/beam_search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

template <typename Real>
struct GridSearcher {
    const SearchTarget<Real>& target;

    template <class Quest>
    HWY_INLINE void operator()(Quest& quest) const
    {
        search_root(target, EagerResolver(*target.structure), quest);
    }
    std::uint64_t version() const { return target.geometry->version(); }
    const Grid* top() const { return &target.structure->grids[0]; }

    template <class BeamQuest>
    void beam(BeamQuest& quest) const
    {
        const BeamRootPrimitives primitives{*target.geometry};
        BeamSearch<BeamQuest, BeamRootPrimitives> search{quest, quest.root, primitives, target.structure,
                                                         target.precision == Precision::fast ? 1.0f : 0.0f};
        search.run(quest.root.packets, EagerResolver(*target.structure));
    }
};

void closest_float(const SearchTarget<float>& target, RayTile<float>& tile)
{
    search_tile<Query::closest>(tile, target.precision, GridSearcher<float>{target});
}
void closest_double(const SearchTarget<double>& target, RayTile<double>& tile)
{
    search_tile<Query::closest>(tile, target.precision, GridSearcher<double>{target});
}
void any_float(const SearchTarget<float>& target, RayTile<float>& tile)
{
    search_tile<Query::any>(tile, target.precision, GridSearcher<float>{target});
}
void any_double(const SearchTarget<double>& target, RayTile<double>& tile)
{
    search_tile<Query::any>(tile, target.precision, GridSearcher<double>{target});
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace firstray::inline v0 {

HWY_EXPORT(closest_float);
HWY_EXPORT(closest_double);
HWY_EXPORT(any_float);
HWY_EXPORT(any_double);

void search_closest(const SearchTarget<float>& target, RayTile<float>& tile)
{
    HWY_DYNAMIC_DISPATCH(closest_float)(target, tile);
}
void search_closest(const SearchTarget<double>& target, RayTile<double>& tile)
{
    HWY_DYNAMIC_DISPATCH(closest_double)(target, tile);
}
void search_any(const SearchTarget<float>& target, RayTile<float>& tile)
{
    HWY_DYNAMIC_DISPATCH(any_float)(target, tile);
}
void search_any(const SearchTarget<double>& target, RayTile<double>& tile)
{
    HWY_DYNAMIC_DISPATCH(any_double)(target, tile);
}

}  // namespace firstray::inline v0
#endif  // HWY_ONCE
