#pragma once
#include <vector>

#include "engine/strategy/strategy.h"
#include "tests/support/test_rays.h"

namespace firstray::test {

/// Rays whose nearest hit is not, bit for bit, the list's; or whose occlusion differs.
/// hits  raised by how many of the rays hit something
template <typename Real>
int differences(const Strategy<Real>& list, const Strategy<Real>& other, const std::vector<TestRay>& rays, int& hits)
{
    int different = 0;
    for (const RayMask mask : {RayMask::all, RayMask::opaque, RayMask::transmitting})
        for (std::size_t first = 0; first < rays.size(); first += RayTile<Real>::capacity) {
            const auto expected = make_tile<Real>(rays, first, mask), found = make_tile<Real>(rays, first, mask),
                       any = make_tile<Real>(rays, first, mask);
            list.closest(*expected);
            other.closest(*found);
            other.occluded(*any);
            for (std::size_t i = 0; i < static_cast<std::size_t>(expected->count); ++i) {
                const bool hit = expected->primitive[i] != no_primitive;
                hits += hit;
                bool same = expected->primitive[i] == found->primitive[i] && expected->t_max[i] == found->t_max[i] &&
                            hit == (any->primitive[i] != no_primitive);
                if (hit) same = same && expected->u[i] == found->u[i] && expected->v[i] == found->v[i];
                different += !same;
            }
        }
    return different;
}

}  // namespace firstray::test
