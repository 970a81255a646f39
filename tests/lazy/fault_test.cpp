#include <doctest/doctest.h>

#include "engine/strategy/list.h"
#include "lazy/lazy.h"
#include "tests/lazy/lazy_world.h"
#include "tests/support/failing_new.h"

using namespace firstray;
using namespace firstray::test;

namespace {

int differing(const RayTile<float>& a, const RayTile<float>& b)
{
    int different = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(a.count); ++i)
        different += a.primitive[i] != b.primitive[i] || a.t_max[i] != b.t_max[i];
    return different;
}

}  // namespace

TEST_CASE("lazy: whichever allocation fails while rays fly, they find what they find")
{
    const Scene scene = scene_with_movers(3, 150, 3, 30);
    const Pose now = pose(scene, 0.0);
    const StrategyOptions options{.grid_density = 1.0f, .max_list = 8};
    for (const bool is_beam : {false, true}) {
        CAPTURE(is_beam);
        const std::vector<TestRay> rays =
            is_beam ? rays_from(4, scene, {1, 2, 30}, 200) : awkward_rays(4, scene, 200);
        const auto list = make_list<float>(scene, options);
        list->update(now);
        const auto expected = make_tile<float>(rays, 0);
        list->closest(*expected);
        int failures = 0, thrown = 0;
        for (std::int64_t k = 0;; ++k) {
            CAPTURE(k);
            const auto lazy = lazy::make_lazy<float>(scene, options);
            lazy->update(now);
            const auto found = make_tile<float>(rays, 0), again = make_tile<float>(rays, 0);
            bool is_whole = true, has_failed;
            {
                const FailingNew failing(k);
                try {
                    lazy->closest(*found);
                } catch (const std::bad_alloc&) {
                    is_whole = false;  // not while building: a search needs room for itself
                }
                has_failed = failing.has_failed();
            }
            if (is_whole) CHECK(differing(*expected, *found) == 0);
            if (is_whole && has_failed) CHECK(lazy->report().refused_builds == 1);  // it is counted
            lazy->closest(*again);
            CHECK(differing(*expected, *again) == 0);
            thrown += !is_whole;
            if (!has_failed) break;
            ++failures;
        }
        CHECK(failures > 100);
        CHECK(thrown <= 4);
        MESSAGE(failures << " allocations failed, one after the other; " << thrown << " searches gave up");
    }
}
