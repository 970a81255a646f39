// A kite flaps its wings above a floor: meshes of a program's own, posed and traced frame by frame.
#include <firstray/engine/scene/meshes.h>
#include <firstray/engine/strategy/tracer.h>
#include <firstray/strategies.h>

#include <cstdio>

int main()
{
    const std::vector<glm::vec3> floor = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
    std::vector<glm::vec3> kite = {{-1, 0, 0}, {0, 0, -1}, {1, 0, 0}, {0, 0, 1}};
    const std::vector<glm::uvec3> quad = {{0, 1, 3}, {1, 2, 3}};

    firstray::Meshes meshes;
    meshes.add({.positions = floor, .indices = quad});
    const std::uint32_t flyer = meshes.add_group("kite");
    meshes.add({.positions = kite, .indices = quad, .vertices = firstray::Vertices::live}, flyer);
    const firstray::Scene scene = meshes.scene();
    firstray::Tracer tracer(scene, firstray::make_strategy("lazy", scene));

    const std::vector<firstray::Tracer::Ray> rays = {{.origin = {0.5f, 9, 0}, .direction = {0, -1, 0}},
                                                     {.origin = {2.5f, 9, 0}, .direction = {0, -1, 0}}};
    std::vector<firstray::Tracer::Hit> hits(rays.size());
    for (int frame = 0; frame < 3; ++frame) {
        kite[0].y = kite[2].y = static_cast<float>(frame);
        const firstray::Transform places[] = {{.offset = {frame, 4, 0}}};  // root_from_group, one per group
        tracer.update(places);
        tracer.closest(rays, hits);
        for (const firstray::Tracer::Hit& hit : hits)
            std::printf("frame %d: t = %g, mesh %u, triangle %u\n", frame, hit.t, hit.mesh, hit.triangle);
    }
}
