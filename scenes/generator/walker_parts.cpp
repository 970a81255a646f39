#include "scenes/generator/walker_parts.h"

#include <algorithm>

#include "scenes/generator/gait.h"
#include "scenes/generator/looks.h"

namespace firstray::scenes {
namespace {

constexpr double grain = 1e-4;

/// Collects a part: shapes of one material become one mesh.
class Part {
public:
    Part& add(const Material& material, const Mesh& shape, const Transform& place = {})
    {
        if (meshes_.empty() || !(meshes_.back().material == material)) meshes_.push_back({material, {}});
        append(meshes_.back().mesh, shape, place);
        return *this;
    }
    std::vector<PaintedMesh> meshes()
    {
        for (PaintedMesh& painted : meshes_) snap(painted.mesh, grain);
        return std::move(meshes_);
    }

private:
    std::vector<PaintedMesh> meshes_;
};

/// A disc or knob that faces +z.
Mesh knob(double radius, double height, int around)
{
    const double r = radius, b = 0.25 * std::min(radius, height);
    const glm::dvec2 profile[] = {{r, 0.0}, {r, height - b}, {r - b, height}, {0.0, height}};
    Mesh mesh;
    append(mesh, lathe(profile, around), turn({1, 0, 0}, 90));
    return mesh;
}

/// A box with flat sides.
Mesh plate(const glm::dvec3& half)
{
    Mesh mesh;
    add_box(mesh, -half, half);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        glm::dvec3 normal(0.0);
        normal[static_cast<int>(i) / 4] = i / 2 % 2 ? 1.0 : -1.0;
        mesh.normals.push_back(normal);
        mesh.triangles[i].normal = glm::uvec3(static_cast<unsigned>(i));
    }
    return mesh;
}

/// A flexible hose that hangs down.
Mesh hose(double radius, double length, int rings, int around)
{
    std::vector<glm::dvec2> profile;
    for (int i = 0; i <= 2 * rings; ++i)
        profile.emplace_back(radius * (i % 2 ? 1.0 : 0.78), -length + length * i / (2.0 * rings));
    return lathe(profile, around);
}

/// A limb's shell that hangs down from y = top to y = bottom.
Mesh shell(double top, double bottom, double top_radius, double bottom_radius, int around)
{
    const double b = 0.02;
    const glm::dvec2 profile[] = {{0.0, bottom},         {bottom_radius - b, bottom}, {bottom_radius, bottom + b},
                                  {top_radius, top - b}, {top_radius - b, top},       {0.0, top}};
    return lathe(profile, around);
}

struct WalkerPaint {
    Material body, trim, steel, dark;
};

std::vector<PaintedMesh> torso_part(const WalkerPaint& p)
{
    Part part;
    part.add(p.body, rounded_box({0.25, 0.24, 0.17}, 0.07, 2), shift({0, 0.27, 0}));
    part.add(p.body, rounded_box({0.17, 0.17, 0.07}, 0.03, 1), shift({0, 0.29, -0.21}));
    part.add(p.trim, rounded_box({0.16, 0.11, 0.02}, 0.015, 1), shift({0, 0.32, 0.17}));
    part.add(p.dark, knob(0.055, 0.02, 14), shift({-0.085, 0.345, 0.19}));
    for (int i = 0; i < 3; ++i) part.add(p.dark, plate({0.06, 0.008, 0.006}), shift({0.075, 0.375 - 0.028 * i, 0.192}));
    const glm::vec3 lamps[] = {{0.9f, 0.2f, 0.1f}, {0.95f, 0.75f, 0.15f}, {0.2f, 0.7f, 0.35f}};
    for (int i = 0; i < 3; ++i)
        part.add(glossy(lamps[i] * 1.2f, 0.2f, 60.0f), ball(0.018, 4, 8), shift({0.03 + 0.05 * i, 0.255, 0.192}));
    for (const double x : {-0.075, 0.075})
        part.add(p.steel, shell(0.50, 0.10, 0.035, 0.035, 10), shift({x, 0.0, -0.30}));
    for (const double x : {-0.30, 0.30}) part.add(p.steel, ball(0.085, 6, 14), shift({x, 0.43, 0}));
    part.add(p.dark, hose(0.075, 0.10, 2, 12), shift({0, 0.60, 0}));
    part.add(p.dark, hose(0.15, 0.12, 2, 16), shift({0, 0.06, 0}));
    return part.meshes();
}

std::vector<PaintedMesh> head_part(const WalkerPaint& p)
{
    const Material eye{
        .ambient = {1.3f, 1.05f, 0.45f}, .diffuse = {0.3f, 0.25f, 0.1f}, .specular = glm::vec3(0.3f), .shine = 60.0f};
    Part part;
    const glm::dvec2 dome[] = {{0.0, 0.02},   {0.15, 0.02},  {0.175, 0.05}, {0.185, 0.12}, {0.18, 0.18},
                               {0.155, 0.24}, {0.11, 0.285}, {0.05, 0.305}, {0.0, 0.31}};
    part.add(p.body, lathe(dome, 22));
    part.add(p.trim, rounded_box({0.13, 0.055, 0.03}, 0.025, 1), shift({0, 0.165, 0.155}));
    for (const double x : {-0.062, 0.062}) {
        part.add(p.dark, knob(0.048, 0.03, 12), shift({x, 0.168, 0.17}));
        part.add(eye, ball(0.034, 5, 10), shift({x, 0.168, 0.192}));
    }
    for (int i = 0; i < 5; ++i) part.add(p.dark, plate({0.008, 0.018, 0.012}), shift({-0.06 + 0.03 * i, 0.07, 0.172}));
    for (const double side : {-1.0, 1.0})
        part.add(p.steel, knob(0.05, 0.05, 12), turn({0, 1, 0}, side * 90) * shift({0, 0.15, 0.165}));
    return part.meshes();
}

std::vector<PaintedMesh> hand_part(const WalkerPaint& p)
{
    Part part;
    part.add(p.dark, shell(0.02, -0.05, 0.05, 0.055, 12));
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 finger[] = {
            {0, -0.04, 0.03}, {0, -0.08, 0.055}, {0, -0.125, 0.055}, {0, -0.165, 0.03}, {0, -0.17, 0.025}};
        const double thick[] = {0.017, 0.018, 0.015, 0.012, 0.002};
        part.add(p.steel, tube(finger, thick, 6), turn({0, 1, 0}, i == 0 ? 180 : i * 60 - 90));
    }
    return part.meshes();
}

void add_arm(WalkerParts& parts, const WalkerPaint& p)
{
    parts.upper_arm =
        Part().add(p.dark, hose(0.052, 0.26, 5, 10)).add(p.steel, ball(0.058, 5, 12), shift({0, -0.28, 0})).meshes();
    parts.forearm = Part()
                        .add(p.body, shell(-0.03, -0.20, 0.058, 0.075, 13))
                        .add(p.trim, shell(-0.20, -0.245, 0.082, 0.082, 13))
                        .meshes();
    parts.hand = hand_part(p);
}

void add_leg(WalkerParts& parts, const WalkerPaint& p)
{
    constexpr double thigh = thigh_length, shin = shin_length;
    parts.thigh = Part()
                      .add(p.body, shell(-0.04, -thigh + 0.07, 0.082, 0.068, 13))
                      .add(p.steel, ball(0.072, 5, 12), shift({0, -thigh, 0}))
                      .meshes();
    parts.shin = Part()
                     .add(p.body, shell(-0.06, -shin + 0.10, 0.072, 0.092, 13))
                     .add(p.trim, shell(-shin + 0.10, -shin + 0.05, 0.10, 0.10, 13))
                     .add(p.dark, hose(0.06, 0.09, 2, 10), shift({0, -shin + 0.06, 0}))
                     .meshes();
    parts.foot = Part()
                     .add(p.trim, rounded_box({0.085, 0.06, 0.135}, 0.04, 1), shift({0, -0.065, 0.0}))
                     .add(p.dark, rounded_box({0.09, 0.015, 0.14}, 0.012, 1), shift({0, -0.115, 0}))
                     .meshes();
    parts.toe = Part()
                    .add(p.body, rounded_box({0.088, 0.045, 0.075}, 0.04, 1), shift({0, -0.002, 0.05}))
                    .add(p.dark, rounded_box({0.09, 0.014, 0.08}, 0.012, 1), shift({0, -0.041, 0.05}))
                    .meshes();
}

}  // namespace

WalkerParts walker_parts(const Paint& paint)
{
    const WalkerPaint p{glossy(paint.body, 0.10f, 50.0f), glossy(paint.trim, 0.06f, 40.0f),
                        metal({0.70f, 0.72f, 0.75f}, 0.35f, 40.0f), glossy({0.11f, 0.11f, 0.13f}, 0.05f, 20.0f)};
    WalkerParts parts;
    parts.hips = Part()
                     .add(p.body, rounded_box({0.17, 0.085, 0.12}, 0.05, 1))
                     .add(p.steel, ball(0.075, 5, 12), shift({0.13, 0, 0}))
                     .add(p.steel, ball(0.075, 5, 12), shift({-0.13, 0, 0}))
                     .meshes();
    parts.torso = torso_part(p);
    parts.head = head_part(p);
    const glm::dvec2 rod[] = {{0.03, 0.0}, {0.03, 0.02}, {0.009, 0.025}, {0.007, 0.17}};
    parts.antenna = Part()
                        .add(p.steel, lathe(rod, 8))
                        .add(glossy({1.0f, 0.3f, 0.12f}, 0.2f, 60.0f), ball(0.028, 5, 8), shift({0, 0.19, 0}))
                        .meshes();
    add_arm(parts, p);
    add_leg(parts, p);
    return parts;
}

}  // namespace firstray::scenes
