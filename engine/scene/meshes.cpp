#include "engine/scene/meshes.h"

#include <algorithm>
#include <cmath>

#include "engine/core/errors.h"

namespace firstray::inline v0 {
namespace {

/// Numbers below this fit where `none` means that there is no such thing.
constexpr std::uint64_t most = none;

/// The positions that a mesh names: [first, last]; first > last where there are no triangles.
struct Range {
    std::uint32_t first = none, last = 0;
};

std::string text(std::string_view what, std::size_t number)
{
    return std::string(what) + " " + std::to_string(number);
}

[[noreturn]] void refuse(std::uint32_t mesh, const std::string& what, const std::string& expected)
{
    throw Error(Fault::usage, text("mesh", mesh) + ": " + what + ", expected " + expected);
}

Range named_by(const Mesh& mesh, std::uint32_t number)
{
    Range range;
    for (std::size_t triangle = 0; triangle < mesh.indices.size(); ++triangle)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[triangle][k];
            if (vertex >= mesh.positions.size())
                refuse(number, text("triangle", triangle) + " names vertex " + std::to_string(vertex),
                       "an index below " + std::to_string(mesh.positions.size()));
            range = {std::min(range.first, vertex), std::max(range.last, vertex)};
        }
    return range;
}

void check_finite(const Mesh& mesh, std::uint32_t number)
{
    for (std::size_t triangle = 0; triangle < mesh.indices.size(); ++triangle)
        for (int k = 0; k < 3; ++k) {
            const std::uint32_t vertex = mesh.indices[triangle][k];
            const glm::vec3& p = mesh.positions[vertex];
            if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
                refuse(number, text("vertex", vertex) + " is not finite", "numbers");
        }
}

std::uint32_t count_of(const auto& list)
{
    return static_cast<std::uint32_t>(list.size());
}

}  // namespace

std::uint32_t Meshes::add_group(std::string name)
{
    names_.push_back(std::move(name));
    return groups() - 1;
}

std::uint32_t Meshes::add(const Mesh& mesh, std::uint32_t group)
{
    const std::uint32_t number = meshes();
    if (group >= groups())
        refuse(number, text("there is no group", group), "one that add_group made, or Meshes::scenery");
    const Range range = named_by(mesh, number);
    check_finite(mesh, number);
    Draft draft;
    draft.group = group;
    draft.vertices = mesh.vertices;
    draft.material = mesh.material;
    if (range.first <= range.last) draft.lent = mesh.positions.subspan(range.first, range.last - range.first + 1);
    if (vertices_ + draft.lent.size() >= most || triangles_ + mesh.indices.size() >= most)
        throw LimitError(text("mesh", number) + ": more than " + std::to_string(most) + " in all",
                         vertices_ + draft.lent.size() >= most ? "vertices" : "triangles");
    vertices_ += draft.lent.size();
    triangles_ += mesh.indices.size();
    if (mesh.vertices == Vertices::copied) draft.copy.assign(draft.lent.begin(), draft.lent.end());
    draft.indices.assign(mesh.indices.begin(), mesh.indices.end());
    for (glm::uvec3& index : draft.indices) index -= range.first;
    drafts_.push_back(std::move(draft));
    return number;
}

/// A mesh becomes a part of the last group.
void Meshes::append(const Draft& draft, std::uint32_t number, Scene& scene)
{
    Group& group = scene.groups.back();
    const std::uint32_t first_vertex = static_cast<std::uint32_t>(scene.vertex_count());
    Part part;
    part.node = group.node;
    part.group = count_of(scene.groups) - 1;
    part.material = number;
    part.mesh = number;
    part.first = count_of(scene.part_of_primitive);
    part.count = count_of(draft.indices);
    group.vertices += count_of(draft.positions());
    group.triangles += part.count;
    if (draft.vertices == Vertices::copied) {
        scene.positions.insert(scene.positions.end(), draft.copy.begin(), draft.copy.end());
    } else if (!draft.lent.empty()) {
        const std::uint32_t shared_before = scene.shared.empty() ? 0 : scene.shared.back().through;
        scene.shared.push_back({first_vertex, count_of(draft.lent), shared_before + count_of(draft.lent), draft.lent.data()});
    }
    for (const glm::uvec3& index : draft.indices) scene.triangles.push_back({.vertex = index + first_vertex});
    scene.part_of_primitive.insert(scene.part_of_primitive.end(), part.count, count_of(scene.parts));
    scene.parts.push_back(part);
}

/// All meshes of a group that are live, or all that are not.
void Meshes::append_group(std::uint32_t group, bool live, Scene& scene) const
{
    Group made;
    made.node = group;
    made.deforming = made.live = live;
    made.first = count_of(scene.part_of_primitive);
    made.first_triangle = count_of(scene.triangles);
    made.first_vertex = static_cast<std::uint32_t>(scene.vertex_count());
    scene.groups.push_back(made);
    for (std::uint32_t i = 0; i < meshes(); ++i) {
        const Draft& draft = drafts_[i];
        const bool belongs = draft.group == group && (draft.vertices == Vertices::live) == live;
        if (belongs && !draft.indices.empty()) append(draft, i, scene);
    }
    const bool is_scenery = scene.groups.size() == 1;  // is there even when it is empty
    if (!is_scenery && scene.groups.back().triangles == 0) scene.groups.pop_back();
}

Scene Meshes::scene() const
{
    Scene scene;
    for (const Draft& draft : drafts_) scene.materials.push_back(draft.material);
    for (std::uint32_t group = 0; group < groups(); ++group) {
        Node& node = scene.nodes.emplace_back();
        node.name = names_[group];
        if (group != scenery) {
            node.parent = 0;
            node.dynamic = true;
        }
        append_group(group, false, scene);
        append_group(group, true, scene);
    }
    return scene;
}

}  // namespace firstray::inline v0
