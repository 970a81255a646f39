#include "bench/firstray/structure_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace firstray::command {
namespace {

const char* name_of(StructureBox::Kind kind)
{
    switch (kind) {
        case StructureBox::Kind::grid:
            return "grid";
        case StructureBox::Kind::box:
            return "box";
        case StructureBox::Kind::supergrid:
            return "supergrid";
        case StructureBox::Kind::subgrid:
            return "subgrid";
    }
    return "";
}

Json to_json(const glm::dvec3& v)
{
    return {v.x, v.y, v.z};
}

Json describe_box(const StructureBox& box, const glm::dvec3& origin)
{
    const glm::dmat3& edges = box.root_from_box.linear;
    const bool has_grid = box.dims != glm::ivec3(0);
    return {{"name", box.name},
            {"kind", name_of(box.kind)},
            {"level", box.level},
            {"size", to_json(box.size())},
            {"primitives", box.primitives},
            {"references", box.references},
            {"resolution", has_grid ? Json{box.dims.x, box.dims.y, box.dims.z} : Json(nullptr)},
            {"filled_cells", box.filled_cells.size()},
            {"subgrids", {{"count", 0}, {"deepest_level", nullptr}}},
            {"corner", to_json(box.root_from_box.offset + origin)},
            {"edges", {to_json(edges[0]), to_json(edges[1]), to_json(edges[2])}}};
}

void count_subgrid(Json& subgrids, int level)
{
    subgrids["count"] = subgrids["count"].get<int>() + 1;
    const bool is_deeper = subgrids["deepest_level"].is_null() || subgrids["deepest_level"].get<int>() < level;
    if (is_deeper) subgrids["deepest_level"] = level;
}

constexpr std::size_t columns = 9;
using Row = std::array<std::string, columns>;

Row row_of(const Json& box)
{
    const Json &size = box["size"], &resolution = box["resolution"], &subgrids = box["subgrids"];
    const int level = box["level"].get<int>();
    std::string inside = subgrids["count"].dump();
    if (subgrids["count"] != 0) inside += fmt::format(", down to level {}", subgrids["deepest_level"].dump());
    return {
        std::string(2 * static_cast<std::size_t>(std::max(level, 0)), ' ') + box["name"].get<std::string>(),
        box["kind"].get<std::string>(),
        std::to_string(level),
        fmt::format("{:.4g} x {:.4g} x {:.4g}", size[0].get<double>(), size[1].get<double>(), size[2].get<double>()),
        box["primitives"].dump(),
        box["references"].dump(),
        resolution.is_null()
            ? "list"
            : fmt::format("{}x{}x{}", resolution[0].dump(), resolution[1].dump(), resolution[2].dump()),
        box["filled_cells"].dump(),
        inside};
}

}  // namespace

Json describe_structure(std::span<const StructureBox> outline, const glm::dvec3& origin)
{
    Json boxes = Json::array();
    std::vector<std::size_t> holder;  // by level: of `boxes`, where the last box of that level was told
    for (const StructureBox& box : outline) {
        const auto level = static_cast<std::size_t>(std::max(box.level, 0));
        const std::size_t parent = level > 0 && level <= holder.size() ? holder[level - 1] : boxes.size();
        holder.resize(level, parent);
        if (box.kind == StructureBox::Kind::subgrid && parent < boxes.size()) {
            holder.push_back(parent);
            count_subgrid(boxes[parent]["subgrids"], box.level);
        } else {
            holder.push_back(boxes.size());
            boxes.push_back(describe_box(box, origin));
        }
    }
    return boxes;
}

std::string structure_table(const Json& structure)
{
    constexpr std::array<bool, columns> to_the_right = {false, false, true, true, true, true, true, true, false};
    std::vector<Row> rows = {
        {"name", "kind", "level", "size", "primitives", "references", "resolution", "filled", "subgrids"}};
    for (const Json& box : structure) rows.push_back(row_of(box));
    std::array<std::size_t, columns> widths{};
    for (const Row& row : rows)
        for (std::size_t c = 0; c < columns; ++c) widths[c] = std::max(widths[c], row[c].size());
    std::string text;
    for (const Row& row : rows) {
        for (std::size_t c = 0; c + 1 < columns; ++c)
            text += to_the_right[c] ? fmt::format("{:>{}}  ", row[c], widths[c])
                                    : fmt::format("{:<{}}  ", row[c], widths[c]);
        text += row.back() + "\n";
    }
    return text;
}

}  // namespace firstray::command
