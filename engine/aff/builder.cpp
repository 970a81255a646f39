#include "engine/aff/builder.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "engine/scene/pose.h"

namespace firstray::inline v0 {
namespace {

/// Positions are stored in double but carried to float.
bool fits_float(const glm::dvec3& p)
{
    constexpr double largest = std::numeric_limits<float>::max();
    return std::abs(p.x) <= largest && std::abs(p.y) <= largest && std::abs(p.z) <= largest;
}

bool is_finite(const Transform& t)
{
    return fits_float(t.linear[0]) && fits_float(t.linear[1]) && fits_float(t.linear[2]) && fits_float(t.offset);
}

/// Zero, unless the scene lies so far from it that float coordinates would lose three bits or more to the distance:
/// then the scene's centre, on a grid of powers of two so that differences to it stay short numbers.
glm::dvec3 choose_origin(const Scene& scene)
{
    const DAabb box = bounds(pose(scene, scene.start));
    if (box.empty()) return glm::dvec3(0.0);
    const double diagonal = glm::length(box.size());
    const glm::dvec3 centre = box.lo + 0.5 * box.size();
    if (!(diagonal > 0.0) || !std::isfinite(diagonal) || glm::length(centre) <= 8.0 * diagonal) return glm::dvec3(0.0);
    const double step = std::exp2(std::floor(std::log2(diagonal)));
    return glm::round(centre / step) * step;
}

}  // namespace

std::size_t SceneBuilder::MaterialHash::operator()(const Material& m) const
{
    std::size_t hash = 0;
    for (const glm::vec3& v : {m.ambient, m.diffuse, m.specular, glm::vec3(m.shine, m.transmittance, m.ior)})
        for (int i = 0; i < 3; ++i) hash = hash * 31 + std::hash<float>{}(v[i]);
    return hash;
}

SceneBuilder::SceneBuilder(const ReadLimits& limits) : limits_(limits)
{
    scene.nodes.emplace_back();
    drafts_[{0, false}];  // the static scenery is group 0 even when it is empty
}

void SceneBuilder::count(std::string_view statement)
{
    for (auto& [name, times] : scene.census.statements)
        if (name == statement) {
            ++times;
            return;
        }
    scene.census.statements.emplace_back(statement, 1);
}

void SceneBuilder::check_room(std::size_t primitives, const Lexer& in) const
{
    if (primitives > limits_.primitives - primitives_) in.over_limit("primitives", limits_.primitives, "primitives");
}

void SceneBuilder::check_vertices(std::size_t more, std::size_t list, const Lexer& in) const
{
    if (list > limits_.vertices || more > limits_.vertices - list) in.over_limit("vertices", limits_.vertices, "vertices");
}

void SceneBuilder::push_node(Node node, const Open& open, const Lexer& in)
{
    if (depth() >= limits_.transform_depth)
        in.over_limit("transforms inside each other", limits_.transform_depth, "transform_depth");
    if (scene.nodes.size() > limits_.transforms) in.over_limit("transforms", limits_.transforms, "transforms");
    node.parent = open_.back().node;
    scene.nodes.push_back(std::move(node));
    open_.push_back(open);
}

void SceneBuilder::open_static(const Transform& parent_from_node, const Lexer& in)
{
    Open open = open_.back();
    open.node = static_cast<std::uint32_t>(scene.nodes.size());
    open.owner_from_node = open.owner_from_node * parent_from_node;
    if (!is_finite(open.owner_from_node))
        in.statement_fault("transform that, with those around it, leaves the range of float", "a smaller one");
    Node node;
    node.parent_from_node = parent_from_node;
    push_node(std::move(node), open, in);
}

void SceneBuilder::open_dynamic(const std::string& name, const Lexer& in)
{
    Open open = open_.back();
    // A dynamic node stands directly in its parent's system, which may be a static node's.
    open.owner = open.node = static_cast<std::uint32_t>(scene.nodes.size());
    open.owner_from_node = {};
    Node node;
    node.dynamic = true;
    node.name = name;
    push_node(std::move(node), open, in);
}

std::uint32_t SceneBuilder::texture(const std::string& name, const Lexer& in)
{
    const auto [entry, is_new] = textures_.try_emplace(name, static_cast<std::uint32_t>(scene.textures.size()));
    if (!is_new) return entry->second;
    if (scene.textures.size() >= limits_.textures) in.over_limit("textures", limits_.textures, "textures");
    scene.textures.push_back(name);
    scene.texture_places.push_back(in.mention().place);
    return entry->second;
}

std::uint32_t SceneBuilder::material_index()
{
    const auto [entry, is_new] = materials_.try_emplace(material, static_cast<std::uint32_t>(scene.materials.size()));
    if (is_new) scene.materials.push_back(material);
    return entry->second;
}

Part SceneBuilder::make_part(std::size_t first, std::size_t count, std::uint32_t texture)
{
    Part part;
    part.node = open_.back().node;
    part.material = material_index();
    part.texture = texture;
    part.first = static_cast<PrimitiveId>(first);
    part.count = static_cast<std::uint32_t>(count);
    primitives_ += count;
    return part;
}

glm::dvec3 SceneBuilder::baked(const glm::dvec3& point, const Lexer& in) const
{
    const glm::dvec3 result = open_.back().owner_from_node.point(point);
    if (!fits_float(result))
        in.statement_fault("point that its transforms carry out of the range of float", "a nearer one");
    return result;
}

std::uint32_t SceneBuilder::add_normal(const glm::dvec3& normal)
{
    const glm::dvec3 n = normal_matrix(open_.back().owner_from_node) * normal;
    const double length = glm::length(n);
    scene.normals.emplace_back(length > 0.0 ? n / length : glm::dvec3(0.0));
    return static_cast<std::uint32_t>(scene.normals.size() - 1);
}

void SceneBuilder::add(TriangleList list, const Lexer& in)
{
    if (list.triangles.empty()) return;
    check_room(list.triangles.size(), in);
    check_vertices(list.positions.size(), vertices_, in);
    check_vertices(list.normals.size(), scene.normals.size(), in);
    check_vertices(list.uvs.size(), scene.uvs.size(), in);
    Draft& group = draft(false);
    group.triangle_parts.push_back(make_part(group.triangles.size(), list.triangles.size(), list.texture));
    const auto first_normal = static_cast<std::uint32_t>(scene.normals.size());
    for (const glm::dvec3& normal : list.normals) add_normal(normal);
    const auto first_uv = static_cast<std::uint32_t>(scene.uvs.size());
    scene.uvs.insert(scene.uvs.end(), list.uvs.begin(), list.uvs.end());

    // Only vertices that a triangle names: others would cost time in every frame and widen the bounds.
    std::vector<std::uint32_t> place(list.positions.size(), none);
    for (TriangleIndices triangle : list.triangles) {
        for (int k = 0; k < 3; ++k) {
            std::uint32_t& vertex = place[triangle.vertex[k]];
            if (vertex == none) {
                vertex = static_cast<std::uint32_t>(group.positions.size());
                group.positions.push_back(baked(list.positions[triangle.vertex[k]], in));
                ++vertices_;
            }
            triangle.vertex[k] = vertex;
            if (triangle.normal[k] != none) triangle.normal[k] += first_normal;
            if (triangle.uv[k] != none) triangle.uv[k] += first_uv;
        }
        group.triangles.push_back(triangle);
    }
}

void SceneBuilder::add(Quadric quadric, const Lexer& in)
{
    check_room(1, in);
    quadric.group_from_quadric = open_.back().owner_from_node * quadric.group_from_quadric;
    if (!is_finite(quadric.group_from_quadric) || is_singular(quadric.group_from_quadric))
        in.statement_fault("sphere, cone or cylinder that is flat, a line or a point", "one with a volume");
    Draft& group = draft(false);
    group.quadric_parts.push_back(make_part(group.quadrics.size(), 1, none));
    group.quadrics.push_back(quadric);
}

void SceneBuilder::add(std::vector<DeformingKey> keys, std::vector<DeformingNormals> normals, const Lexer& in)
{
    check_room(1, in);
    check_vertices(3, vertices_, in);
    vertices_ += 3;
    Draft& group = draft(true);
    group.triangle_parts.push_back(make_part(group.triangles.size(), 1, none));
    for (DeformingKey& key : keys)
        for (glm::dvec3& position : key.position) position = baked(position, in);
    const glm::dmat3 owner_from_normal = normal_matrix(open_.back().owner_from_node);
    for (DeformingNormals& at_key : normals)
        for (glm::vec3& normal : at_key.corner) normal = glm::vec3(owner_from_normal * glm::dvec3(normal));
    group.deforming.push_back(
        {static_cast<std::uint32_t>(scene.deforming_keys.size()), static_cast<std::uint32_t>(keys.size())});
    TriangleIndices indices;
    indices.vertex = glm::uvec3(0, 1, 2) + static_cast<std::uint32_t>(group.positions.size());
    group.triangles.push_back(indices);
    group.positions.insert(group.positions.end(), std::begin(keys[0].position), std::end(keys[0].position));
    scene.deforming_keys.insert(scene.deforming_keys.end(), keys.begin(), keys.end());
    scene.deforming_normals.insert(scene.deforming_normals.end(), normals.begin(), normals.end());
}

void SceneBuilder::set_animation(Animation animation)
{
    const auto [entry, is_new] =
        animations_.try_emplace(animation.name, static_cast<std::uint32_t>(scene.animations.size()));
    if (is_new) scene.animations.emplace_back();
    scene.animations[entry->second] = std::move(animation);
}

void SceneBuilder::add_light(const Light& light, const std::string& name, const Lexer& in)
{
    if (scene.lights.size() >= limits_.lights) in.over_limit("lights", limits_.lights, "lights");
    if (!name.empty()) animated_lights_.emplace_back(scene.lights.size(), name);
    scene.lights.push_back(light);
}

std::uint32_t SceneBuilder::animation_named(const std::string& name) const
{
    const auto found = animations_.find(name);
    return found == animations_.end() ? none : found->second;
}

void SceneBuilder::append_parts(const std::vector<Part>& parts, PrimitiveId first)
{
    for (Part part : parts) {
        part.group = static_cast<std::uint32_t>(scene.groups.size());
        part.first += first;
        scene.part_of_primitive.insert(scene.part_of_primitive.end(), part.count,
                                       static_cast<std::uint32_t>(scene.parts.size()));
        scene.parts.push_back(part);
    }
}

void SceneBuilder::append_group(std::uint32_t node, bool deforming, Draft draft)
{
    const auto size = [](const auto& list) { return static_cast<std::uint32_t>(list.size()); };
    Group group;
    group.node = node;
    group.deforming = deforming;
    group.first = size(scene.part_of_primitive);
    group.triangles = size(draft.triangles);
    group.quadrics = size(draft.quadrics);
    group.first_triangle = size(scene.triangles);
    group.first_quadric = size(scene.quadrics);
    group.first_vertex = size(scene.positions);
    group.vertices = size(draft.positions);
    group.first_deforming = size(scene.deforming);

    for (TriangleIndices& triangle : draft.triangles) triangle.vertex += group.first_vertex;
    const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
    append(scene.positions, draft.positions);
    append(scene.triangles, draft.triangles);
    append(scene.quadrics, draft.quadrics);
    append(scene.deforming, draft.deforming);
    append_parts(draft.triangle_parts, group.first);
    append_parts(draft.quadric_parts, group.first + group.triangles);
    scene.groups.push_back(group);
}

Scene SceneBuilder::finish()
{
    for (auto& [key, content] : drafts_) append_group(key.first, key.second, std::exchange(content, {}));
    for (Node& node : scene.nodes)
        if (node.dynamic) node.animation = animation_named(node.name);
    for (const auto& [light, name] : animated_lights_) scene.lights[light].animation = animation_named(name);
    scene.camera_animation = animation_named("camera");
    scene.origin = choose_origin(scene);
    return std::move(scene);
}

}  // namespace firstray::inline v0
