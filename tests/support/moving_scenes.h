#pragma once
#include <glm/glm.hpp>

#include <initializer_list>
#include <sstream>
#include <string>
#include <vector>

#include "engine/scene/pose.h"
#include "tests/support/scene_files.h"
#include "tests/support/test_rays.h"

namespace firstray::test {

/// How a transform of a moving scene moves, and what is special about what it carries.
enum class Motion {
    rigid,
    grows,       ///< by 1 to 3 per axis, differently
    mirrors,     ///< one axis by -1, the others alike
    tiny,        ///< by 1e-6, what it carries is 1e6 times as large
    huge,        ///< by 1e6, what it carries is 1e6 times as small
    explodes,    ///< from 1e-5 to 1e5, alike
    flattens,    ///< along one axis, to a plane at the end
    vanishes,    ///< to a point at the start
    blinks,      ///< hidden for a while
    speck,       ///< by 1e-6, what it carries stays a speck
    flies_away,  ///< to 3e4
    still,       ///< has no keys
    count
};

/// How many of what a moving scene has.
struct MovingScene {
    int scenery = 60, clusters = 6, triangles = 12;
    int boxes = 2;  ///< per cluster, nested
    bool has_deforming = true;
    std::vector<Motion> motions{};  ///< of its transforms, in turn; none: any
    glm::dvec3 offset{0.0};         ///< of all
};

/// Writes moving scenes of 9 frames, at times 0 to 8, as AFF.
class MovingSceneText {
public:
    MovingSceneText(std::uint64_t seed, const MovingScene& shape) : random_(seed), shape_(shape)
    {
        text_.precision(17);
    }

    std::string write()
    {
        text_ << "a 0 8 9\nxs 1 1 1 0 0 1 0 ";
        put(shape_.offset);
        text_ << "{\n";
        if (shape_.scenery > 0) primitives(shape_.scenery, 10.0, 1.0);
        if (shape_.has_deforming) deforming(shape_.triangles, 5.0);
        for (int cluster = 0; cluster < shape_.clusters; ++cluster) moving(0);
        text_ << "}\n";
        return text_.str();
    }

private:
    void put(const glm::dvec3& v) { text_ << v.x << ' ' << v.y << ' ' << v.z << ' '; }
    void put_key(double time, const glm::dvec3& v)
    {
        text_ << time << ' ';
        put(v);
        text_ << "0 0 0\n";
    }

    void material() { text_ << "fm 0.2 0.2 0.2 0.5 0.5 0.5 0 0 0 0 " << (random_.unit() < 0.3 ? 0.5 : 0.0) << " 0\n"; }

    /// A mesh of triangles of every size, a sphere and a cone now and then.
    void primitives(int triangles, double reach, double unit)
    {
        material();
        text_ << "m vertices " << 3 * triangles << '\n';
        for (int i = 0; i < triangles; ++i) {
            const double size = reach * std::pow(10.0, random_.between(-2.0, 0.0));
            const glm::dvec3 a = random_.in_cube(reach);
            const glm::dvec3 b = a + random_.in_cube(size), c = i % 13 == 7 ? b : a + random_.in_cube(size);
            for (const glm::dvec3& p : {a, b, c}) put(p * unit);
        }
        text_ << "\ntriangles " << triangles << '\n';
        for (int i = 0; i < triangles; ++i) text_ << 3 * i << ' ' << 3 * i + 1 << ' ' << 3 * i + 2 << '\n';
        material();
        if (random_.unit() < 0.5) {
            text_ << "s ";
            put(random_.in_cube(reach) * unit);
            text_ << random_.between(0.1, 0.5) * reach * unit << '\n';
        }
        if (random_.unit() < 0.3) {
            text_ << "c ";
            put(random_.in_cube(reach) * unit);
            text_ << random_.between(0.05, 0.3) * reach * unit << ' ';
            put(random_.in_cube(reach) * unit);
            text_ << random_.between(0.05, 0.3) * reach * unit << '\n';
        }
    }

    void deforming(int triangles, double reach)
    {
        for (int i = 0; i < triangles; ++i) {
            text_ << "tpa 3\n";
            const glm::dvec3 centre = random_.in_cube(reach);
            for (const double time : {1.0, 4.0, 7.0}) {
                text_ << time << ' ';
                for (int corner = 0; corner < 3; ++corner) {
                    put(centre + random_.in_cube(0.5 * reach));
                    text_ << "0 0 1 ";
                }
                text_ << '\n';
            }
        }
    }

    Motion next_motion()
    {
        if (!shape_.motions.empty()) return shape_.motions[names_ % shape_.motions.size()];
        return static_cast<Motion>(random_.below(static_cast<std::uint32_t>(Motion::count)));
    }

    /// A transform with primitives, and others in it.
    void moving(int depth)
    {
        const Motion motion = next_motion();
        const std::string name = "x" + std::to_string(names_++);
        keys(name, motion, depth == 0 ? 8.0 : 2.0);
        const double unit = motion == Motion::tiny ? 1e6 : motion == Motion::huge ? 1e-6 : 1.0;
        text_ << "x " << name << " {\n";
        primitives(shape_.triangles, 1.5, unit);
        text_ << "xs " << unit << ' ' << 0.5 * unit << ' ' << unit << "  1 2 3 40  0 " << unit << " 0 {\n";
        primitives(shape_.triangles / 2 + 1, 1.0, 1.0);
        if (depth + 1 < shape_.boxes) moving(depth + 1);
        text_ << "}\n";
        if (shape_.has_deforming && unit == 1.0 && names_ % 5 == 4) deforming(shape_.triangles / 2 + 1, 1.0);
        text_ << "}\n";
    }

    void keys(const std::string& name, Motion motion, double reach)
    {
        if (motion == Motion::still) return;
        text_ << "k " << name << " {\ntransl 5\n";
        const double end = motion == Motion::flies_away ? 3e4 : reach;
        for (const double time : {-1.0, 0.0, 3.0, 8.0, 9.0}) put_key(time, random_.in_cube(time < 3.0 ? reach : end));
        text_ << "rot 5\n";
        for (const double time : {-1.0, 0.0, 4.0, 8.0, 9.0}) {
            text_ << time << ' ';
            put(random_.in_cube(1.0));
            text_ << random_.between(-90.0, 90.0) << " 0 0 0\n";
        }
        scale_keys(motion);
        if (motion == Motion::blinks) text_ << "visibility 3  2 0  4 1  6 0\n";
        text_ << "}\n";
    }

    void scale_keys(Motion motion)
    {
        const auto track = [&](const glm::dvec3& start, const glm::dvec3& middle, const glm::dvec3& end) {
            text_ << "scale 5\n";
            put_key(-1.0, start);
            put_key(0.0, start);
            put_key(4.0, middle);
            put_key(8.0, end);
            put_key(9.0, end);
        };
        const glm::dvec3 one(1.0);
        if (motion == Motion::grows) track(one, {1.2, 3.0, 0.4}, one + random_.in_cube(0.5));
        if (motion == Motion::mirrors) track({-1, 1, 1}, {-1, 1, 1}, {-1, 1, 1});
        if (motion == Motion::tiny) track(one * 1e-6, one * 2e-6, one * 1e-6);
        if (motion == Motion::huge) track(one * 1e6, one * 2e6, one * 1e6);
        if (motion == Motion::explodes) track(one * 1e-5, one, one * 1e5);
        if (motion == Motion::flattens) track(one, {1.0, 0.3, 1.0}, {1.0, 0.0, 1.0});
        if (motion == Motion::vanishes) track(glm::dvec3(0.0), one, one * 0.5);
        if (motion == Motion::speck) track(one * 1e-6, one * 1e-6, one * 1e-6);
    }

    Random random_;
    MovingScene shape_;
    std::ostringstream text_;
    std::size_t names_ = 0;
};

inline Scene moving_scene(std::uint64_t seed, const MovingScene& shape = {})
{
    return scene_of(MovingSceneText(seed, shape).write());
}

/// A scene of nothing but the visible vertices of a pose, and middles of quadrics, where they stand in the root system:
/// for rays to be aimed at. Never empty.
inline Scene targets_of(const Pose& pose)
{
    Scene targets;
    const Scene& scene = *pose.scene;
    for (const Group& group : scene.groups) {
        if (!pose.is_visible(group)) continue;
        std::vector<glm::dvec3> carried(group.vertices);
        carry_vertices(pose, group, carried.data());
        targets.positions.insert(targets.positions.end(), carried.begin(), carried.end());
        for (std::uint32_t i = 0; i < group.quadrics; ++i)
            targets.positions.push_back(pose.root_from_node[group.node].point(
                scene.quadrics[group.first_quadric + i].group_from_quadric.offset));
    }
    if (targets.positions.empty()) targets.positions.emplace_back(0.0);
    return targets;
}

}  // namespace firstray::test
