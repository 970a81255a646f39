#pragma once
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "engine/strategy/strategy.h"
#include "tests/support/test_rays.h"

namespace firstray::test {

/// What the list finds along rays, with every mask: asked once, however many strategies are held to it.
template <typename Real>
class Expected {
public:
    Expected(const Strategy<Real>& list, std::vector<TestRay> rays) : rays_(std::move(rays))
    {
        for (const RayMask mask : {RayMask::all, RayMask::opaque, RayMask::transmitting})
            for (std::size_t first = 0; first < rays_.size(); first += RayTile<Real>::capacity) {
                tiles_.push_back({first, make_tile<Real>(rays_, first, mask)});
                list.closest(*tiles_.back().found);
            }
    }

    /// Rays whose nearest hit is not, bit for bit, the list's; or whose occlusion differs; or of which `other` wrongly
    /// says that they meet nothing that transmits.
    /// hits  raised by how many of the rays hit something
    int differences(const Strategy<Real>& other, int& hits) const
    {
        int different = 0;
        for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
            const auto& [first, expected] = tiles_[tile];
            // A third of the tiles for each mask; of the same rays, those for the next mask come so much later.
            const RayTile<Real>* const transmitting =
                expected->mask == RayMask::opaque ? tiles_[tile + tiles_.size() / 3].found.get() : nullptr;
            std::vector<std::uint8_t> may_pass(static_cast<std::size_t>(expected->count), 1);
            const auto found = make_tile<Real>(rays_, first, expected->mask),
                       any = make_tile<Real>(rays_, first, expected->mask);
            other.closest(*found);
            any->may_pass = may_pass.data();
            other.occluded(*any);
            for (std::size_t i = 0; i < static_cast<std::size_t>(expected->count); ++i) {
                const bool hit = expected->primitive[i] != no_primitive;
                hits += hit;
                bool same = expected->primitive[i] == found->primitive[i] && expected->t_max[i] == found->t_max[i] &&
                            hit == (any->primitive[i] != no_primitive);
                if (hit) same = same && expected->u[i] == found->u[i] && expected->v[i] == found->v[i];
                if (transmitting && !hit) same = same && (may_pass[i] || transmitting->primitive[i] == no_primitive);
                different += !same;
            }
        }
        return different;
    }

private:
    struct Tile {
        std::size_t first;
        std::unique_ptr<RayTile<Real>> found;
    };
    std::vector<TestRay> rays_;
    std::vector<Tile> tiles_;
};

/// The same where a single strategy is compared.
template <typename Real>
int differences(const Strategy<Real>& list, const Strategy<Real>& other, const std::vector<TestRay>& rays, int& hits)
{
    return Expected<Real>(list, rays).differences(other, hits);
}

}  // namespace firstray::test
