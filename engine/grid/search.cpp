#include "engine/grid/search.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/grid/search.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "engine/grid/search-inl.h"

HWY_BEFORE_NAMESPACE();
namespace firstray {
namespace HWY_NAMESPACE {

/// Everything is there: a cell's word says where.
class EagerResolver {
public:
    explicit EagerResolver(const GridStructure& structure)
        : cells_(structure.cells.data()), lists_(structure.lists.data()), grids_(structure.grids.data())
    {
    }
    CellWord word(std::int32_t cell) const { return cells_[cell]; }
    Voxel voxel(CellWord word, std::int32_t /*cell*/) const
    {
        if (word.is_subgrid()) return {nullptr, &grids_[word.index()]};
        return {&lists_[word.index()], nullptr};
    }

private:
    const CellWord* HWY_RESTRICT cells_;
    const VoxelList* HWY_RESTRICT lists_;
    const Grid* HWY_RESTRICT grids_;
};

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
