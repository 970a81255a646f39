#include "engine/grid/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/grid/search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/grid/search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray {
namespace HWY_NAMESPACE {

template <typename Real>
struct GridSearcher {
    const SearchTarget<Real>& target;

    template <class Quest>
    HWY_INLINE void operator()(Quest& quest) const
    {
        search_root(target, EagerResolver(*target.structure), quest);
    }
};

void closest_float(const SearchTarget<float>& target, RayTile<float>& tile)
{
    search_tile<Query::closest>(tile, GridSearcher<float>{target});
}
void closest_double(const SearchTarget<double>& target, RayTile<double>& tile)
{
    search_tile<Query::closest>(tile, GridSearcher<double>{target});
}
void any_float(const SearchTarget<float>& target, RayTile<float>& tile)
{
    search_tile<Query::any>(tile, GridSearcher<float>{target});
}
void any_double(const SearchTarget<double>& target, RayTile<double>& tile)
{
    search_tile<Query::any>(tile, GridSearcher<double>{target});
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace firstray {

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

}  // namespace firstray
#endif  // HWY_ONCE
