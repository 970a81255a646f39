// Renders that are given up in the middle, and several at a time in one process.
#include <doctest/doctest.h>

#include <atomic>
#include <stdexcept>

#include "bench/strategies.h"
#include "engine/render/render.h"
#include "tests/support/crew.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;

namespace {

constexpr RenderOptions small_picture{.width = 120, .height = 90, .depth = 2};

/// What moves among lights and a mirror; the camera looks at all of it.
Scene filmed_scene(std::uint64_t seed)
{
    Scene scene = moving_scene(seed);
    scene.view = {.from = {0, 4, 30}, .at = {0, 0, 0}, .angle = 50.0, .hither = 0.1};
    scene.lights.push_back({.position = {10, 20, 15}});
    for (std::size_t i = 0; i < scene.materials.size(); i += 2) scene.materials[i].specular = glm::vec3(0.3f);
    return scene;
}

/// A scene, its executor and a strategy: what a process may have several of.
class Engine {
public:
    Engine(const StrategyEntry& entry, std::uint64_t seed, int threads)
        : scene_(filmed_scene(seed)), executor_(threads), strategy_(entry.make(scene_, {.executor = &executor_}))
    {
    }
    Strategy<float>& strategy() { return *strategy_; }
    const Executor& executor() const { return executor_; }

    const Pose& update(int frame)
    {
        Pose& next = poses_[++updates_ % 2];
        next = pose(scene_, scene_.time_of(frame));
        strategy_->update(next);
        return next;
    }
    std::uint64_t hash(int frame)
    {
        Frame picture;
        const Pose& now = update(frame);
        render<float>(*strategy_, now, {}, small_picture, executor_, picture);
        return image_hash(picture);
    }

private:
    Scene scene_;
    Executor executor_;
    std::unique_ptr<Strategy<float>> strategy_;
    Pose poses_[2];
    int updates_ = 0;
};

/// Passes searches on until it has had enough.
class Cancelled : public Strategy<float> {
public:
    Cancelled(const Strategy<float>& strategy, int searches) : strategy_(strategy), left_(searches) {}
    void update(const Pose&) override {}
    void closest(RayTile<float>& rays) const override
    {
        count();
        strategy_.closest(rays);
    }
    void occluded(RayTile<float>& rays) const override
    {
        count();
        strategy_.occluded(rays);
    }
    StructureReport report() const override { return {}; }

private:
    void count() const
    {
        if (--left_ < 0) throw std::runtime_error("cancelled");
    }
    const Strategy<float>& strategy_;
    mutable std::atomic<int> left_;
};

}  // namespace

TEST_CASE("a render that is cancelled in the middle leaves the strategy as good as before")
{
    int cancelled = 0;
    for (const StrategyEntry& entry : strategies()) {
        if (entry.peer) continue;
        CAPTURE(entry.name);
        Engine undisturbed(entry, 5, 1), engine(entry, 5, 4);
        for (const int frame : {2, 5, 3})
            for (const int searches : {0, 1, 7, 20}) {
                CAPTURE(searches);
                Frame picture;
                const Pose& now = engine.update(frame);
                CHECK_THROWS_WITH(render<float>(Cancelled(engine.strategy(), searches), now, {}, small_picture,
                                                engine.executor(), picture),
                                  "cancelled");
                ++cancelled;
                CHECK(engine.hash(frame) == undisturbed.hash(frame));
            }
    }
    MESSAGE(cancelled << " renders cancelled");
}

TEST_CASE("two engines in one process do not disturb each other")
{
    int frames = 0;
    for (const StrategyEntry& entry : strategies()) {
        if (entry.peer) continue;  // Embree limits TBB for the whole process
        CAPTURE(entry.name);
        std::vector<std::uint64_t> alone[2], together[2];
        for (const int which : {0, 1}) {
            Engine engine(entry, static_cast<std::uint64_t>(6 + which), 2);
            for (int frame = 0; frame < 6; ++frame) alone[which].push_back(engine.hash(frame));
        }
        Crew(2).run([&](int which) {
            Engine engine(entry, static_cast<std::uint64_t>(6 + which), 1 + 2 * which);
            for (int frame = 0; frame < 6; ++frame) together[which].push_back(engine.hash(frame));
        });
        for (const int which : {0, 1}) CHECK(alone[which] == together[which]);
        CHECK(alone[0] != alone[1]);
        frames += 12;
    }
    MESSAGE(frames << " frames compared");
}
