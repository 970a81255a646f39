#include "obb/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "obb/search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "obb/search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0::obb {
namespace HWY_NAMESPACE {

void closest_float(const SearchTarget<float>& target, Visits& visits, RayTile<float>& tile)
{
    search_tile<Query::closest>(tile, target.precision, Searcher<float>{target, visits});
}
void closest_double(const SearchTarget<double>& target, Visits& visits, RayTile<double>& tile)
{
    search_tile<Query::closest>(tile, target.precision, Searcher<double>{target, visits});
}
void any_float(const SearchTarget<float>& target, Visits& visits, RayTile<float>& tile)
{
    search_tile<Query::any>(tile, target.precision, Searcher<float>{target, visits});
}
void any_double(const SearchTarget<double>& target, Visits& visits, RayTile<double>& tile)
{
    search_tile<Query::any>(tile, target.precision, Searcher<double>{target, visits});
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0::obb
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace firstray::inline v0::obb {
HWY_EXPORT(closest_float);
HWY_EXPORT(closest_double);
HWY_EXPORT(any_float);
HWY_EXPORT(any_double);

void search_closest(const SearchTarget<float>& target, RayTile<float>& tile)
{
    HWY_DYNAMIC_DISPATCH(closest_float)(target, Visits::of_this_thread(), tile);
}
void search_closest(const SearchTarget<double>& target, RayTile<double>& tile)
{
    HWY_DYNAMIC_DISPATCH(closest_double)(target, Visits::of_this_thread(), tile);
}
void search_any(const SearchTarget<float>& target, RayTile<float>& tile)
{
    HWY_DYNAMIC_DISPATCH(any_float)(target, Visits::of_this_thread(), tile);
}
void search_any(const SearchTarget<double>& target, RayTile<double>& tile)
{
    HWY_DYNAMIC_DISPATCH(any_double)(target, Visits::of_this_thread(), tile);
}

}  // namespace firstray::inline v0::obb
#endif  // HWY_ONCE
