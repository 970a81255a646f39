#include "engine/render/draw_structure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "engine/render/line_layer.h"

namespace firstray::inline v0 {
namespace {

/// Lines of a picture this high or lower are as thin as can be; those of higher ones are wider in proportion.
constexpr double thin_height = 600.0;
constexpr double box_width = 1.6, cell_width = 1.0;
constexpr float cell_strength = 0.65f;

/// There may be thousands of subgrids: their boxes fade as cells this many times smaller do.
constexpr double subgrid_fading = 3.0;

/// A picture as a background for lines: darker and closer to grey.
void subdue(std::vector<glm::vec3>& picture)
{
    constexpr float colourfulness = 0.6f, brightness = 0.5f;
    const glm::vec3 weights(0.2126f, 0.7152f, 0.0722f);
    for (glm::vec3& colour : picture)
        colour = brightness * glm::mix(glm::vec3(glm::dot(colour, weights)), colour, colourfulness);
}

/// An edge between two corners of cells, as a number that sorts edges of one line one behind the other: the axis, the
/// line's place on the other two axes, and the place along it.
using EdgeKey = std::uint64_t;
constexpr int key_bits = 20;  // a place; more than any grid has
constexpr EdgeKey place_mask = (EdgeKey{1} << key_bits) - 1;

EdgeKey edge_key(int axis, const glm::ivec3& corner)
{
    const auto place = [&](int a) { return static_cast<EdgeKey>(corner[a % 3]); };
    return static_cast<EdgeKey>(axis) << (3 * key_bits) | place(axis + 2) << (2 * key_bits) |
           place(axis + 1) << key_bits | place(axis);
}

int axis_of(EdgeKey key)
{
    return static_cast<int>(key >> (3 * key_bits));
}

glm::dvec3 start_of(EdgeKey key)
{
    const int axis = axis_of(key);
    glm::dvec3 corner;
    for (int k = 0; k < 3; ++k) corner[(axis + k) % 3] = static_cast<double>(key >> (k * key_bits) & place_mask);
    return corner;
}

/// The edges of cells, each once though neighbours share it, in order.
std::vector<EdgeKey> cell_edges(const glm::ivec3& dims, std::span<const std::uint32_t> cells)
{
    std::vector<EdgeKey> edges;
    edges.reserve(12 * cells.size());
    for (const std::uint32_t cell : cells) {
        const auto index = static_cast<int>(cell);
        const glm::ivec3 corner(index % dims.x, index / dims.x % dims.y, index / dims.x / dims.y);
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 4; ++side) {
                glm::ivec3 start = corner;
                start[(axis + 1) % 3] += side & 1;
                start[(axis + 2) % 3] += side >> 1;
                edges.push_back(edge_key(axis, start));
            }
    }
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

/// How far apart the lines along each axis stand that bound a box's cells: across the axis with the smaller cells, of
/// those with more than one.
glm::dvec3 line_spacing(const StructureBox& box)
{
    const glm::dvec3 cell = box.size() / glm::dvec3(box.dims);
    glm::dvec3 spacing;
    for (int axis = 0; axis < 3; ++axis) {
        const int b = (axis + 1) % 3, c = (axis + 2) % 3;
        spacing[axis] = std::max(cell[b], cell[c]);
        for (const int across : {b, c})
            if (box.dims[across] > 1) spacing[axis] = std::min(spacing[axis], cell[across]);
    }
    return spacing;
}

std::vector<std::uint32_t> cells_in(const StructureBox& box, StructureBox::Voxel state)
{
    std::vector<std::uint32_t> cells;
    for (std::size_t i = 0; i < box.filled_cells.size(); ++i)
        if (box.states[i] == state) cells.push_back(box.filled_cells[i]);
    return cells;
}

class StructureDrawing {
public:
    StructureDrawing(const Frame& frame, const CameraRays& camera)
        : camera_(camera), layer_(frame, camera), width_scale_(std::max(frame.height / thin_height, 1.0))
    {
    }

    void draw(const StructureBox& box)
    {
        const glm::vec3 colour = level_colour(box.level);
        Pen pen{.colour = colour, .width = box_width * width_scale_};
        if (box.kind == StructureBox::Kind::subgrid) {
            const glm::dvec3 size = box.size();
            pen.spacing = std::max({size.x, size.y, size.z}) / subgrid_fading;
        }
        draw_edges(box.root_from_box, pen);
        if (!glm::all(glm::greaterThan(box.dims, glm::ivec3(0)))) return;
        pen = {.colour = colour, .strength = cell_strength, .width = cell_width * width_scale_};
        if (box.states.empty()) return draw_cells(box, box.filled_cells, pen);
        for (const StructureBox::Voxel state :
             {StructureBox::Voxel::unbuilt, StructureBox::Voxel::kept, StructureBox::Voxel::built}) {
            pen.colour = voxel_colour(state);
            draw_cells(box, cells_in(box, state), pen);
        }
    }

    void cover(std::vector<glm::vec3>& picture) const { layer_.cover(picture); }

private:
    void draw_edges(const Transform& root_from_box, const Pen& pen)
    {
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 4; ++side) {
                glm::dvec3 start(0.0);
                start[(axis + 1) % 3] = side & 1;
                start[(axis + 2) % 3] = side >> 1;
                glm::dvec3 end = start;
                end[axis] = 1.0;
                layer_.draw(root_from_box.point(start), root_from_box.point(end), pen);
            }
    }

    /// Draws the edges of some cells of a box; edges in a row are one line.
    void draw_cells(const StructureBox& box, std::span<const std::uint32_t> cells, Pen pen)
    {
        const glm::dvec3 spacing = line_spacing(box);
        if (is_too_fine(box, std::max({spacing.x, spacing.y, spacing.z}))) return;
        const std::vector<EdgeKey> edges = cell_edges(box.dims, cells);
        const glm::dvec3 dims(box.dims);
        for (std::size_t i = 0; i < edges.size();) {
            std::size_t end = i + 1;
            while (end < edges.size() && edges[end] == edges[end - 1] + 1) ++end;
            const int axis = axis_of(edges[i]);
            const glm::dvec3 from = start_of(edges[i]);
            glm::dvec3 to = from;
            to[axis] += static_cast<double>(end - i);
            pen.spacing = spacing[axis];
            layer_.draw(box.root_from_box.point(from / dims), box.root_from_box.point(to / dims), pen);
            i = end;
        }
    }

    /// Whether lines so far apart would be too close in the picture wherever they are in a box.
    bool is_too_fine(const StructureBox& box, double spacing) const
    {
        double nearest = std::numeric_limits<double>::infinity();
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec3 p(corner & 1, corner >> 1 & 1, corner >> 2);
            nearest = std::min(nearest, project(camera_, box.root_from_box.point(p)).z);
        }
        return spacing <= faded_spacing * std::max(nearest, camera_.hither) * glm::length(camera_.next_column);
    }

    const CameraRays& camera_;
    LineLayer layer_;
    double width_scale_;
};

}  // namespace

Frame draw_structure(const Frame& frame, const CameraRays& camera, std::span<const StructureBox> outline)
{
    StructureDrawing drawing(frame, camera);
    for (const StructureBox& box : outline) drawing.draw(box);
    Frame drawn = frame;
    subdue(drawn.colour);
    drawing.cover(drawn.colour);
    return drawn;
}

glm::vec3 voxel_colour(StructureBox::Voxel state)
{
    switch (state) {
        case StructureBox::Voxel::built:
            return level_colour(1);
        case StructureBox::Voxel::kept:
            return level_colour(4);
        default:
            return glm::vec3(0.55f);
    }
}

glm::vec3 level_colour(int level)
{
    static constexpr std::array<std::array<int, 3>, 7> palette = {{{86, 180, 233},   // sky blue
                                                                   {230, 159, 0},    // orange
                                                                   {204, 121, 167},  // reddish purple
                                                                   {240, 228, 66},   // yellow
                                                                   {0, 158, 115},    // bluish green
                                                                   {213, 94, 0},     // vermillion
                                                                   {0, 114, 178}}};  // blue
    const auto& rgb = palette[static_cast<std::size_t>(std::max(level, 0)) % palette.size()];
    return glm::vec3(rgb[0], rgb[1], rgb[2]) / 255.0f;
}

}  // namespace firstray::inline v0
