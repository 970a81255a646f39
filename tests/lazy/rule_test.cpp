#include "lazy/rule.h"

#include <doctest/doctest.h>

#include <stdexcept>

#include "tests/lazy/easy_costs.h"
#include "tests/support/test_rays.h"

using namespace firstray;
using namespace firstray::lazy;
using firstray::test::easy;
using firstray::test::Random;

namespace {

/// Sends rays into a place as a chooser without forecast does; returns what that took.
struct Visitor {
    Rule rule;
    Alternatives place;
    std::uint64_t listed = 0, gridded = 0;
    bool is_built = false;

    void send(std::uint64_t rays)
    {
        is_built = is_built || listed + rays >= rays_to_build(rule, place);
        (is_built ? gridded : listed) += rays;
    }
    double took() const { return spent(place, listed, gridded, is_built); }
    double best() const { return least(place, listed + gridded); }
};

}  // namespace

TEST_CASE("rule: costs of places, computed by hand")
{
    // 10 primitives: a pack; 100: 7 packs, of which 3 are met, in a block of boxes; 5000: 3 packs and 4 blocks
    const Alternatives group = group_alternatives(easy, 10, true);
    CHECK(group.once == 10);
    CHECK(group.list == 10);
    CHECK(group.grid == 2);
    CHECK(group.build == 20 + 10 * 2 + 20 + 10 * 2);
    CHECK(group_alternatives(easy, 100, false).grid == 1 + 4);
    CHECK(group_alternatives(easy, 100, false).build == 20 + 100 * 2);

    const Alternatives voxel = voxel_alternatives(easy, 5000);
    CHECK(voxel.once == 0);
    CHECK(voxel.list == 5000);
    CHECK(voxel.grid == 7);
    CHECK(voxel.build == 20 + 5000 * 2);

    // 1000 primitives: 63 packs in 4 blocks of boxes; four voxels of 3 packs and 4 blocks
    const Alternatives scenery = scenery_alternatives(easy, 1000, 5.0);
    CHECK(scenery.pack == 3000);
    CHECK(scenery.list == 4 + 5);
    CHECK(scenery.grid == 4 * 7);
    CHECK(scenery.build == 20 + 1000 * (2 + 2));
}

TEST_CASE("rule: where carrying costs more than one test alone saves, nothing is carried for a list")
{
    Costs costs = easy;
    costs.carrying = 100;
    CHECK(is_carried_first(easy));
    CHECK(!is_carried_first(costs));
    const Alternatives group = group_alternatives(costs, 10, true);
    CHECK(group.once == 0);
    CHECK(group.list == 10 * 100);
    CHECK(group.build == 80 + 10 * 100);
}

TEST_CASE("rule: a grid is built with the first ray whose list would cost more than building and the grid")
{
    const Alternatives place{.primitives = 10, .list = 10, .grid = 2, .build = 80};
    CHECK(rays_to_build({}, place) == 11);  // ten rays: 100 in the list, 80 + 20 with a grid
    CHECK(rays_to_build({.choice = ListOrGrid::always_grid}, place) == 1);
    CHECK(rays_to_build({.choice = ListOrGrid::always_list}, place) == never);
    CHECK(rays_to_build({.choice = ListOrGrid::threshold, .threshold = 9}, place) == 1);
    CHECK(rays_to_build({.choice = ListOrGrid::threshold, .threshold = 10}, place) == never);
    CHECK(rays_to_build({}, {.list = 2, .grid = 2, .build = 1}) == never);
    CHECK(rays_to_build({}, {.list = 2, .grid = 3, .build = 1}) == never);
}

TEST_CASE("rule: a scripted history of rays takes what it takes by hand")
{
    Visitor visitor{{}, {.primitives = 10, .once = 7, .list = 10, .grid = 2, .build = 80}};
    CHECK(visitor.took() == 0);
    CHECK(visitor.best() == 0);
    visitor.send(4);
    CHECK(visitor.took() == 7 + 40);
    CHECK(visitor.best() == 7 + 40);
    visitor.send(6);  // the tenth
    CHECK(!visitor.is_built);
    CHECK(visitor.took() == 7 + 100);
    CHECK(visitor.best() == 7 + 100);
    visitor.send(5);
    CHECK(visitor.is_built);
    CHECK(visitor.took() == 7 + 100 + 80 + 10);
    CHECK(visitor.best() == 7 + 80 + 30);
    visitor.send(1000);
    CHECK(visitor.took() == 7 + 100 + 80 + 2010);

    Visitor crowd{{}, {.primitives = 10, .list = 10, .grid = 2, .build = 80}};
    crowd.send(1024);  // so many at once wait for nothing
    CHECK(crowd.took() == 80 + 2048);
    CHECK(crowd.best() == crowd.took());
}

TEST_CASE("rule: no history of rays takes more than twice what is best in hindsight")
{
    Random random(1);
    double worst = 0.0;
    int built = 0;
    for (int history = 0; history < 20000; ++history) {
        CAPTURE(history);
        Visitor visitor{{}, {}};
        visitor.place = {.once = random.unit() < 0.5 ? 0.0 : random.between(0, 1e4),
                         .list = std::pow(10.0, random.between(0, 5)),
                         .grid = std::pow(10.0, random.between(0, 3)),
                         .build = std::pow(10.0, random.between(1, 7))};
        visitor.place.pack = random.unit() < 0.5 ? 0.0 : random.unit() * visitor.place.build;
        const int requests = 1 + static_cast<int>(random.below(200));
        for (int i = 0; i < requests; ++i) {
            visitor.send(random.unit() < 0.8 ? 1 : 1 + random.below(1024));
            worst = std::max(worst, visitor.took() / visitor.best());
        }
        built += visitor.is_built;
    }
    CHECK(worst <= 2.0);
    CHECK(worst > 1.9);  // the histories are hard enough
    CHECK(built > 5000);
    MESSAGE("20000 histories, " << built << " with a grid: at worst " << worst << " times the best");
}

TEST_CASE("rule: words are read, and what is none is refused with what was expected")
{
    Rule rule;
    set_choice(rule, "always-list");
    CHECK(rule.choice == ListOrGrid::always_list);
    set_choice(rule, "threshold=100");
    CHECK(rule.choice == ListOrGrid::threshold);
    CHECK(rule.threshold == 100);
    CHECK(rule.forecasts);
    set_choice(rule, "evidence");
    CHECK(rule.choice == ListOrGrid::learned);
    CHECK(!rule.forecasts);
    set_choice(rule, "learned");
    CHECK(rule.forecasts);
    for (const char* wrong : {"", "list", "threshold", "threshold=", "threshold=-1", "threshold=1x"})
        CHECK_THROWS_AS(set_choice(rule, wrong), std::invalid_argument);

    const Costs costs = replace_costs(easy, "test=3,pack=7.5");
    CHECK(costs.test == 3);
    CHECK(costs.pack == 7.5);
    CHECK(costs.making == easy.making);
    for (const char* wrong : {"", "test", "test=", "test=0", "test=-1", "test=inf", "test=nan", "tests=1", "test=1,"})
        CHECK_THROWS_AS(replace_costs(easy, wrong), std::invalid_argument);
}
