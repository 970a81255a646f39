#include <doctest/doctest.h>

#include <atomic>

#include "engine/strategy/list.h"
#include "lazy/lazy.h"
#include "tests/lazy/easy_costs.h"
#include "tests/lazy/lazy_world.h"
#include "tests/support/compare_hits.h"
#include "tests/support/crew.h"
#include "tests/support/moving_scenes.h"

using namespace firstray;
using namespace firstray::test;
using lazy::ListOrGrid;
using lazy::Rule;

namespace {

/// Ten triangles that rays from below miss.
Scene ten_triangles()
{
    SmallScene small;
    for (int i = 0; i < 10; ++i) small.triangle({}, {-1, -1, 0.1 * i}, {1, -1, 0.1 * i}, {-1, 1, 0.1 * i});
    return small.build();
}

Scene ten_moving_triangles()
{
    Scene scene = SmallScene().build();
    add_mover(scene, ten_triangles());
    return scene;
}

/// Frames of a scene whose node 1 moves, and so many rays into its box in each, one after the other.
class Script {
public:
    Script(const Scene& scene, const Rule& rule) : scene_(scene)
    {
        strategy_ = lazy::make_lazy<float>(scene_, {}, {.rule = rule});
        poses_.reserve(100);
    }
    ChoiceReport frame(bool moves, int rays, int at_once = 1)
    {
        poses_.push_back(pose(scene_, 0.0));
        if (moves) ++moved_;
        if (scene_.nodes.size() > 1) poses_.back().root_from_node[1].offset = {0.01 * moved_, 0, 0};
        strategy_->update(poses_.back());
        for (int ray = 0; ray < rays; ray += at_once) {
            const std::vector<TestRay> some(static_cast<std::size_t>(at_once), {{0.5, 0.7, -5}, {0, 0, 1}});
            strategy_->closest(*make_tile<float>(some, 0));
        }
        return strategy_->report().choices;
    }
    const Strategy<float>& strategy() const { return *strategy_; }

private:
    Scene scene_;
    std::unique_ptr<Strategy<float>> strategy_;
    std::vector<Pose> poses_;
    int moved_ = 0;
};

void check(const ChoiceReport& report, std::uint64_t lists, std::uint64_t grids, double spent_ns, double hindsight_ns)
{
    CHECK(report.is_made);
    CHECK(report.lists == lists);
    CHECK(report.grids == grids);
    CHECK(report.spent_ms * 1e6 == doctest::Approx(spent_ns));
    CHECK(report.hindsight_ms * 1e6 == doctest::Approx(hindsight_ns));
}

constexpr bool moves = true, stands = false;

/// Every way to choose.
std::vector<Rule> rules()
{
    return {{.costs = easy},
            {.forecasts = false},
            {.choice = ListOrGrid::always_grid},
            {.choice = ListOrGrid::always_list},
            {.choice = ListOrGrid::threshold, .threshold = 15}};
}

}  // namespace

TEST_CASE("adaptive: a group that moves gets what its rays, and last frame's, ask for")
{
    Script script(ten_moving_triangles(), {.costs = easy});
    check(script.frame(moves, 0), 0, 0, 0, 0);
    check(script.frame(moves, 5), 1, 0, 10 + 50, 10 + 50);
    check(script.frame(moves, 12), 0, 1, 10 + 100 + 80 + 4, 10 + 80 + 24);  // the 11th has it built
    check(script.frame(moves, 3), 0, 1, 10 + 80 + 6, 10 + 30);              // 12 were expected
    check(script.frame(moves, 3), 1, 0, 10 + 30, 10 + 30);
    check(script.frame(stands, 7), 1, 0, 10 + 100, 10 + 100);  // what stands counts on
    check(script.frame(stands, 1), 0, 1, 10 + 100 + 80 + 2, 10 + 80 + 22);
    check(script.frame(stands, 0), 0, 1, 10 + 100 + 80 + 2, 10 + 80 + 22);
    const ChoiceReport last = script.frame(moves, 0);
    check(last, 0, 0, 0, 0);
    CHECK(last.not_entered == 1);
    check(script.frame(moves, 10), 1, 0, 10 + 100, 10 + 100);  // none were expected
}

TEST_CASE("adaptive: without forecast every frame begins with a list")
{
    Script script(ten_moving_triangles(), {.forecasts = false, .costs = easy});
    for (int frame = 0; frame < 3; ++frame) check(script.frame(moves, 12), 0, 1, 10 + 100 + 80 + 4, 10 + 80 + 24);
}

TEST_CASE("adaptive: lists, grids and thresholds are what was asked for")
{
    const auto one_ray = [](const Rule& rule) { return Script(ten_moving_triangles(), rule).frame(moves, 1); };
    check(one_ray({.choice = ListOrGrid::always_grid, .costs = easy}), 0, 1, 10 + 80 + 2, 10 + 10);
    check(one_ray({.choice = ListOrGrid::threshold, .threshold = 9, .costs = easy}), 0, 1, 10 + 80 + 2, 10 + 10);
    check(one_ray({.choice = ListOrGrid::threshold, .threshold = 10, .costs = easy}), 1, 0, 10 + 10, 10 + 10);
    Script lists(ten_moving_triangles(), {.choice = ListOrGrid::always_list, .costs = easy});
    check(lists.frame(moves, 1000), 1, 0, 10 + 10000, 10 + 80 + 2000);
}

TEST_CASE("adaptive: scenery is a flat list until as much is spent in it as its top grid costs")
{
    // 10 primitives that are one pack, which half of all rays would meet: its boxes' block is tested, and it
    lazy::Costs costs = easy;
    costs.pack = 10;
    costs.listing = 100;
    const lazy::Alternatives place = lazy::scenery_alternatives(costs, 10, 1.0);
    CHECK(place.pack == 30);
    CHECK(place.list == 20);
    CHECK(place.grid == 40);  // of ten primitives never a grid
    Script never(ten_triangles(), {.costs = costs});
    check(never.frame(stands, 1000, 10), 1, 0, 30 + 1000 * 20, 30 + 1000 * 20);
    CHECK(never.strategy().report().grids == 0);

    SmallScene small;
    for (int i = 0; i < 16000; ++i) small.triangle({}, {-1, -1, 1e-5 * i}, {1, -1, 1e-5 * i}, {-1, 1, 1e-5 * i});
    const Scene stack = small.build();
    Script script(stack, {.forecasts = false, .costs = costs});
    const auto grids = [&](Script& played) { return played.strategy().report().grids; };
    // a ray is expected to meet more than half of 1000 packs, in 63 blocks: more than 5 us; 1.6 ms to build
    int frames = 0;
    double list = 0.0;
    for (; grids(script) == 0; ++frames) {
        REQUIRE(frames < 100);
        const ChoiceReport report = script.frame(stands, 10);
        if (grids(script) == 0) list = report.spent_ms * 1e6 - 16000 * 3;
        CHECK(report.ratio() <= 2.0);
    }
    CHECK(frames > 10);
    CHECK(list < 20 + 16000 * 102 + 280 * 1000);       // not more than building, and the same rays in the grid
    CHECK(list > 0.85 * (20 + 16000 * 102));           // nor much less
    CHECK(script.strategy().report().regridded == 0);  // by the ray, not by the update

    Script expecting(stack, {.costs = costs});
    const int almost = 10 * (frames - 1);
    expecting.frame(stands, almost, 10);
    CHECK(grids(expecting) == 0);
    expecting.frame(stands, 0);  // as many more are expected
    CHECK(grids(expecting) == 1);
    CHECK(expecting.strategy().report().regridded == 16000);

    Script crowd(stack, {.forecasts = false, .costs = costs});
    crowd.frame(stands, 1000, 1000);  // so many at once need no list
    CHECK(grids(crowd) == 1);
    CHECK(crowd.strategy().report().choices.ratio() < 1.5);
}

TEST_CASE("adaptive: whatever is chosen, hits are the list's in every frame of moving scenes, with any budget")
{
    int hits = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        CAPTURE(seed);
        const Scene scene = moving_scene(seed, {.scenery = seed == 2 ? 0 : 400});
        std::vector<Pose> poses;
        for (const int frame : {0, 1, 2, 2, 7}) poses.push_back(pose(scene, scene.time_of(frame)));
        const auto list = make_list<float>(scene, {});
        std::vector<Expected<float>> expected;
        for (std::size_t frame = 0; frame < poses.size(); ++frame) {
            list->update(poses[frame]);
            expected.emplace_back(*list, awkward_rays(seed + frame, targets_of(poses[frame]), 150));
        }
        for (std::size_t choice = 0; choice < rules().size(); ++choice)
            for (const std::uint64_t budget : {0ull, 1ull, 50000ull}) {
                CAPTURE(choice);
                CAPTURE(budget);
                const StrategyOptions options{.max_list = 8, .structure_budget = budget};
                const auto adaptive = lazy::make_lazy<float>(scene, options, {.rule = rules()[choice]});
                for (std::size_t frame = 0; frame < poses.size(); ++frame) {
                    CAPTURE(frame);
                    adaptive->update(poses[frame]);
                    CHECK(expected[frame].differences(*adaptive, hits) == 0);
                }
            }
    }
    CHECK(hits > 30000);
    MESSAGE("hits compared: " << hits);
}

TEST_CASE("adaptive: double precision finds the list's hits in double")
{
    int hits = 0;
    const Scene scene = moving_scene(4, {.scenery = 300});
    const auto list = make_list<double>(scene, {.precision = Precision::double_});
    for (const Rule& rule : rules()) {
        const auto adaptive = lazy::make_lazy<double>(scene, {.precision = Precision::double_}, {.rule = rule});
        for (const int frame : {1, 5}) {
            const Pose now = pose(scene, scene.time_of(frame));
            list->update(now);
            adaptive->update(now);
            CHECK(differences(*list, *adaptive, awkward_rays(9, targets_of(now), 200), hits) == 0);
        }
    }
    CHECK(hits > 1000);
}

TEST_CASE("adaptive: eight threads find what the list finds, and count every ray once")
{
    constexpr int threads = 8;
    const Scene scene = moving_scene(5, {.scenery = 500, .clusters = 4, .triangles = 40});
    std::vector<Pose> poses;
    for (const int frame : {0, 1, 2, 3, 3, 4}) poses.push_back(pose(scene, scene.time_of(frame)));
    const auto list = make_list<float>(scene, {});
    for (const Rule& rule : rules()) {
        const auto adaptive = lazy::make_lazy<float>(scene, {.max_list = 8}, {.rule = rule});
        for (const Pose& now : poses) {
            list->update(now);
            adaptive->update(now);
            const auto rays = awkward_rays(6, targets_of(now), 128);
            std::atomic<int> different{0};
            Crew(threads).run([&](int thread) {
                int hits = 0;
                const std::vector<TestRay> own(rays.begin() + 16 * thread, rays.begin() + 16 * (thread + 1));
                different += differences(*list, *adaptive, own, hits);
            });
            CHECK(different == 0);
        }
    }

    Script script(ten_moving_triangles(), {.choice = ListOrGrid::always_list, .costs = easy});
    script.frame(moves, 0);
    Crew(threads).run([&](int) {
        std::vector<TestRay> some(500, {{0.5, 0.7, -5}, {0, 0, 1}});
        some.front().origin.z = -6;  // no beams, which count otherwise
        script.strategy().closest(*make_tile<float>(some, 0));
    });
    CHECK(script.strategy().report().choices.spent_ms * 1e6 == doctest::Approx(10 + 10.0 * threads * 500));
}

TEST_CASE("adaptive: without forecast no frame takes more than twice what is best in hindsight, by the model")
{
    double worst = 0.0;
    std::uint64_t lists = 0, grids = 0;
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
        const Scene scene = moving_scene(seed, {.scenery = 2000, .clusters = 8, .triangles = 60});
        const auto adaptive =
            lazy::make_lazy<float>(scene, {.max_list = 8}, {.rule = Rule{.forecasts = false, .costs = {}}});
        for (int frame = 0; frame < 9; ++frame) {
            const Pose now = pose(scene, scene.time_of(frame));
            adaptive->update(now);
            const auto rays = awkward_rays(seed, targets_of(now), 40 << frame % 6);
            for (std::size_t first = 0; first < rays.size(); first += RayTile<float>::capacity) {
                adaptive->closest(*make_tile<float>(rays, first));
                adaptive->occluded(*make_tile<float>(rays, first));
            }
            const ChoiceReport report = adaptive->report().choices;
            worst = std::max(worst, report.ratio());
            lists += report.lists;
            grids += report.grids;
        }
    }
    CHECK(worst <= 2.0);
    CHECK(worst > 1.0);
    CHECK(lists > 100);
    CHECK(grids > 100);
    MESSAGE("36 frames, " << lists << " lists, " << grids << " grids: at worst " << worst << " times the best");
}
