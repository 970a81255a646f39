#include <algorithm>

#include "engine/grid/outline.h"
#include "obb/obb_strategy.h"

namespace firstray::inline v0::obb {
namespace {

/// Maps the unit cube onto a box.
Transform cube_onto(const DAabb& box)
{
    const glm::dvec3 size = box.size();
    return {glm::dmat3(size.x, 0, 0, 0, size.y, 0, 0, 0, size.z), box.lo};
}

}  // namespace

template <typename Real>
StructureReport ObbStrategy<Real>::report() const
{
    StructureReport report;
    const auto add = [&](const GridStructure& structure) {
        report.grids += !structure.grids.empty();
        report.subgrids += structure.grids.size() - !structure.grids.empty();
        report.voxels += structure.cells.size();
        report.filled_voxels += static_cast<std::uint64_t>(
            std::count_if(structure.cells.begin(), structure.cells.end(), [](CellWord w) { return !w.is_empty(); }));
        report.references += structure.references;
        report.depth = std::max<std::uint64_t>(report.depth, structure.depth);
        report.largest_list = std::max<std::uint64_t>(report.largest_list, structure.largest_list);
    };
    report.bytes = geometry_.bytes() + scenery_.bytes() + outer_.bytes();
    if (has_scenery_) {
        add(scenery_.structure);
        report.primitives += scene_.groups[0].primitives();
    }
    add(outer_.structure);
    for (std::uint32_t i = 0; i < boxes_.size(); ++i) {
        report.bytes +=
            boxes_[i].bytes() + sizeof(Box) + sizeof(First) + sizeof(Fit) + sizeof(BoxPlace) + sizeof(Placed);
        if (!places_[i].is_there) continue;
        if (const GridStructure* inside = boxes_[i].grid()) add(*inside);
        report.refused_builds += boxes_[i].promise && boxes_[i].promise->made.is_refused();
        report.primitives += hierarchy_.boxes[i].count();
    }
    for (const BoxedGrid& supergrid : supergrids_) {
        add(supergrid.structure);
        report.bytes += supergrid.bytes();
    }
    report.regridded = regridded_;
    report.peak_bytes = std::max(peak_bytes_ + geometry_.bytes(), report.bytes);
    return report;
}

template <typename Real>
std::vector<StructureBox> ObbStrategy<Real>::outline() const
{
    std::vector<StructureBox> out;
    if (has_scenery_)
        append_outline(scenery_.structure, scenery_.cells_without_items(), {},
                       {.name = "scenery", .primitives = scene_.groups[0].primitives()}, out);
    for (std::uint32_t i = 0; i < hierarchy_.clusters.size(); ++i) outline_cluster(i, out);
    return out;
}

template <typename Real>
void ObbStrategy<Real>::outline_cluster(std::uint32_t index, std::vector<StructureBox>& out) const
{
    const Cluster& cluster = hierarchy_.clusters[index];
    const std::size_t heading = out.size();
    const bool has_supergrid = !supergrids_[index].structure.grids.empty();
    if (has_supergrid) {
        const ClusterBox box = cluster_boxes_[index];
        const Grid& grid = supergrids_[index].structure.grids[0];
        out.push_back({.kind = StructureBox::Kind::supergrid, .name = cluster.name});
        out.back().root_from_box = Transform{box.axes, glm::dvec3(0.0)} * cube_onto(box.bounds);
        if (grid.cells() > 1) out.back().dims = grid.dims;
        out.back().references = supergrids_[index].structure.references;
    }
    for (std::uint32_t i = cluster.first_box; i < cluster.first_box + cluster.boxes; ++i) {
        if (!places_[i].is_there) continue;
        StructureBox box{.kind = StructureBox::Kind::box,
                         .name = hierarchy_.boxes[i].name,
                         .level = has_supergrid ? 1 : 0,
                         .primitives = hierarchy_.boxes[i].count()};
        if (has_supergrid) out[heading].primitives += box.primitives;
        const GridStructure* inside = boxes_[i].grid();
        if (inside && inside->cells.size() > 1) {
            append_outline(*inside, inside->cells, places_[i].root_from_local, std::move(box), out);
            continue;
        }
        box.root_from_box = places_[i].root_from_local * cube_onto(places_[i].bounds);
        box.references = inside ? inside->references : 0;
        out.push_back(std::move(box));
    }
}

template class ObbStrategy<float>;
template class ObbStrategy<double>;

}  // namespace firstray::inline v0::obb
