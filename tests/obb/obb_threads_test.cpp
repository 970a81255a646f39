#include <doctest/doctest.h>

#include <barrier>
#include <thread>

#include "bench/strategies.h"
#include "engine/aff/reader.h"
#include "engine/render/render.h"
#include "engine/strategy/list.h"
#include "obb/obb.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;

namespace {

std::uint64_t hash_of(const Scene& scene, std::span<const Texture> textures, const char* strategy_name, int frame,
                      int threads)
{
    const Executor executor(threads);
    const auto strategy = find_strategy(strategy_name)->make(scene, {.executor = &executor});
    const Pose now = pose(scene, scene.time_of(frame));
    strategy->update(now);
    Frame picture;
    render<float>(*strategy, now, textures, {.width = 160, .height = 120, .depth = 3}, executor, picture);
    return image_hash(picture);
}

}  // namespace

TEST_CASE("pictures that boxes give are the grid's, with one thread and with two")
{
    const Scene scene = read_aff("scenes/everything.aff");
    std::vector<Texture> textures(scene.textures.size());
    for (Texture& texture : textures) texture = {.width = 1, .height = 1, .pixels = {128, 200, 90}};
    for (const int frame : {0, 30}) {
        CAPTURE(frame);
        const std::uint64_t expected = hash_of(scene, textures, "grid", frame, 1);
        for (const int threads : {1, 2}) {
            CAPTURE(threads);
            CHECK(hash_of(scene, textures, "obb", frame, threads) == expected);
        }
    }
}

TEST_CASE("eight threads that touch groups for the first time at once find what one finds")
{
    constexpr int threads = 8;
    int hits = 0, updates = 0;
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        CAPTURE(seed);
        const Scene scene = moving_scene(seed, {.scenery = 20, .clusters = 5, .triangles = seed % 3 == 0 ? 200 : 8});
        const auto list = make_list<float>(scene, {});
        const auto strategy = obb::make_obb<float>(scene, {});
        for (int round = 0; round < 9; ++round) {
            const Pose now = pose(scene, scene.time_of(round % scene.frames));
            list->update(now);
            strategy->update(now);
            ++updates;
            const std::vector<TestRay> rays = awkward_rays(seed, targets_of(now), 128);
            const auto expected = make_tile<float>(rays, 0);
            list->closest(*expected);
            std::vector<std::unique_ptr<RayTile<float>>> tiles;
            for (int i = 0; i < threads; ++i) tiles.push_back(make_tile<float>(rays, 0));
            std::barrier start(threads);
            {
                std::vector<std::jthread> running;
                for (const auto& tile : tiles)
                    running.emplace_back([&] {
                        start.arrive_and_wait();
                        strategy->closest(*tile);
                    });
            }
            int different = 0;
            for (const auto& tile : tiles)
                for (std::size_t i = 0; i < rays.size(); ++i) {
                    different += tile->primitive[i] != expected->primitive[i] || tile->t_max[i] != expected->t_max[i] ||
                                 (tile->primitive[i] != no_primitive &&
                                  (tile->u[i] != expected->u[i] || tile->v[i] != expected->v[i]));
                    hits += tile->primitive[i] != no_primitive;
                }
            CHECK(different == 0);
        }
    }
    MESSAGE("updates: " << updates << ", hits compared: " << hits);
    CHECK(hits > 10000);
}
