#pragma once
#include <glm/glm.hpp>

#include <cmath>
#include <initializer_list>
#include <optional>
#include <vector>

#include "engine/strategy/strategy.h"

namespace firstray::test {

/// Tests every primitive in double, by the plainest formulas; t, u and v are rounded to Real at the end. For scenes
/// whose only group is the static one, of triangles and spheres. Books one cell a ray and one test a primitive.
template <typename Real>
class ReferenceStrategy : public Strategy<Real> {
public:
    void update(const Pose& pose) override
    {
        pose_ = &pose;
        const Group& group = pose.scene->groups[0];
        std::vector<glm::vec<3, Real, glm::defaultp>> carried(group.vertices);
        carry_vertices(pose, group, carried.data());
        vertices_.assign(carried.begin(), carried.end());
    }

    void closest(RayTile<Real>& rays) const override { search(rays); }

    void occluded(RayTile<Real>& rays) const override
    {
        const auto ends = rays.t_max;
        search(rays);
        rays.t_max = ends;
    }

    StructureReport report() const override { return {}; }

private:
    struct Hit {
        double t, u, v;
    };

    void search(RayTile<Real>& rays) const
    {
        const Scene& scene = *pose_->scene;
        for (int i = 0; i < rays.count; ++i) {
            const auto lane = static_cast<std::size_t>(i);
            rays.primitive[lane] = no_primitive;
            for (PrimitiveId id = 0; id < scene.primitive_count(); ++id)
                if (admits(rays.mask, scene.material(id))) test(rays, i, id);
            if (rays.cost) ++rays.cost[i].cells;
        }
    }

    static bool admits(RayMask mask, const Material& material)
    {
        return mask == RayMask::all || (mask == RayMask::transmitting) == material.transmits();
    }

    void test(RayTile<Real>& rays, int i, PrimitiveId id) const
    {
        const auto lane = static_cast<std::size_t>(i);
        const glm::dvec3 origin(rays.origin_of(i)), direction(rays.direction_of(i));
        const auto try_hit = [&](const Hit& hit) {
            const auto t = static_cast<Real>(hit.t);
            if (!(t > rays.t_min[lane] && t < rays.t_max[lane])) return;
            rays.t_max[lane] = t;
            rays.u[lane] = static_cast<Real>(hit.u);
            rays.v[lane] = static_cast<Real>(hit.v);
            rays.primitive[lane] = id;
        };
        if (rays.cost) ++rays.cost[i].tests;
        if (pose_->scene->is_triangle(id)) {
            if (const auto hit = hit_triangle(origin, direction, id)) try_hit(*hit);
        } else {
            for (const double t : sphere_crossings(origin, direction, id)) try_hit({t, 0.0, 0.0});
        }
    }

    std::optional<Hit> hit_triangle(const glm::dvec3& origin, const glm::dvec3& direction, PrimitiveId id) const
    {
        const glm::uvec3& corner = pose_->scene->triangles[id].vertex;
        const glm::dvec3 a = vertices_[corner.x], e1 = vertices_[corner.y] - a, e2 = vertices_[corner.z] - a;
        const glm::dvec3 normal = glm::cross(e1, e2), from_a = origin - a;
        const double det = -glm::dot(direction, normal);
        if (det == 0.0) return std::nullopt;
        const glm::dvec3 moment = glm::cross(from_a, direction);
        const Hit hit{glm::dot(from_a, normal) / det, glm::dot(e2, moment) / det, -glm::dot(e1, moment) / det};
        if (hit.u < 0.0 || hit.v < 0.0 || hit.u + hit.v > 1.0) return std::nullopt;
        return hit;
    }

    std::vector<double> sphere_crossings(const glm::dvec3& origin, const glm::dvec3& direction, PrimitiveId id) const
    {
        const Scene& scene = *pose_->scene;
        const Transform to_unit = inverse(scene.quadrics[id - scene.groups[0].triangles].group_from_quadric);
        const glm::dvec3 o = to_unit.point(origin), d = to_unit.vector(direction);
        const double a = glm::dot(d, d), b = glm::dot(o, d), c = glm::dot(o, o) - 1.0, root = b * b - a * c;
        if (root < 0.0) return {};
        return {(-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a};
    }

    const Pose* pose_ = nullptr;
    std::vector<glm::dvec3> vertices_;
};

}  // namespace firstray::test
