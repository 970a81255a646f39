#pragma once
#include <glm/glm.hpp>

#include <algorithm>
#include <vector>

#include "engine/scene/scene.h"

namespace firstray::test {

/// Builds scenes of a few static primitives by hand. The view looks from the origin along -z, 90 degrees high.
class SmallScene {
public:
    Scene scene;  ///< everything but primitives may be set directly

    SmallScene()
    {
        scene.view = {.angle = 90.0, .hither = 0.01};
        scene.nodes.emplace_back();
        scene.groups.emplace_back();
    }

    SmallScene& triangle(const Material& material, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c)
    {
        const auto first = static_cast<std::uint32_t>(scene.positions.size());
        scene.positions.insert(scene.positions.end(), {a, b, c});
        scene.triangles.push_back({.vertex = {first, first + 1, first + 2}});
        triangle_materials_.push_back(added(material));
        return *this;
    }

    /// A parallelogram; its normal is cross(u, v).
    /// u, v  from the centre to the middle of two neighbouring edges
    SmallScene& quad(const Material& material, const glm::dvec3& centre, const glm::dvec3& u, const glm::dvec3& v)
    {
        triangle(material, centre - u - v, centre + u - v, centre + u + v);
        return triangle(material, centre - u - v, centre + u + v, centre - u + v);
    }

    SmallScene& sphere(const Material& material, const glm::dvec3& centre, double radius)
    {
        Quadric sphere;
        sphere.group_from_quadric = {glm::dmat3(radius), centre};
        scene.quadrics.push_back(sphere);
        quadric_materials_.push_back(added(material));
        return *this;
    }

    SmallScene& light(const glm::dvec3& position, const glm::vec3& colour = glm::vec3(1.0f))
    {
        scene.lights.push_back({.position = position, .colour = colour});
        return *this;
    }

    /// The scene with its one group and a part for each primitive, triangles first.
    Scene build() const
    {
        Scene result = scene;
        std::vector<std::uint32_t> materials = triangle_materials_;
        materials.insert(materials.end(), quadric_materials_.begin(), quadric_materials_.end());
        for (PrimitiveId id = 0; id < materials.size(); ++id) {
            result.parts.push_back({.material = materials[id], .first = id, .count = 1});
            result.part_of_primitive.push_back(id);
        }
        result.groups[0].triangles = static_cast<std::uint32_t>(scene.triangles.size());
        result.groups[0].quadrics = static_cast<std::uint32_t>(scene.quadrics.size());
        result.groups[0].vertices = static_cast<std::uint32_t>(scene.positions.size());
        return result;
    }

private:
    std::uint32_t added(const Material& material)
    {
        scene.materials.push_back(material);
        return static_cast<std::uint32_t>(scene.materials.size() - 1);
    }

    std::vector<std::uint32_t> triangle_materials_, quadric_materials_;
};

}  // namespace firstray::test
