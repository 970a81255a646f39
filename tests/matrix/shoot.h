#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "bench/strategies.h"
#include "tests/matrix/matrix.h"
#include "tests/support/test_rays.h"

namespace firstray::matrix {

inline constexpr Precision all_precisions[] = {Precision::fast, Precision::robust, Precision::double_};

inline std::string name_of(Precision precision)
{
    return precision == Precision::fast ? "fast" : precision == Precision::robust ? "robust" : "double";
}

/// A strategy that stands at a pose, and what it is called.
template <typename Real>
struct Contender {
    std::string name;
    bool peer = false;
    std::unique_ptr<Strategy<Real>> strategy;
};

/// Our strategies, list first, and after them `embree` where it is asked for and there is one.
template <typename Real>
std::vector<Contender<Real>> contenders(const Scene& scene, const Pose& now, const StrategyOptions& options,
                                        bool with_embree)
{
    std::vector<Contender<Real>> all;
    for (const StrategyEntry& entry : strategies()) {
        if (entry.peer && !(with_embree && entry.name == "embree")) continue;
        if constexpr (std::is_same_v<Real, float>)
            all.push_back({std::string(entry.name), entry.peer, entry.make(scene, options)});
        else if (entry.make_double)
            all.push_back({std::string(entry.name), entry.peer, entry.make_double(scene, options)});
        else
            continue;
        all.back().strategy->update(now);
    }
    return all;
}

/// Calls what(Real()) with the type that a precision computes in.
template <typename What>
void in_type_of(Precision precision, const What& what)
{
    if (precision == Precision::double_)
        what(double());
    else
        what(float());
}

/// Fires rays in tiles, on all threads, and sums up what is made of them.
/// make   rays of a batch, at most a tile's: make(batch) -> std::vector<TestRay>
/// count  count(tile, rays) -> Sum, after the search
/// Sum    is added with +=
template <typename Sum, typename Real, typename Make, typename Count>
Sum shoot(const Executor& executor, const Strategy<Real>& strategy, std::uint64_t batches, const Make& make,
          const Count& count)
{
    std::vector<Sum> sums(batches);
    executor.for_each(batches, [&](std::size_t batch) {
        const std::vector<test::TestRay> rays = make(batch);
        const auto tile = test::make_tile<Real>(rays, 0);
        strategy.closest(*tile);
        sums[batch] = count(*tile, rays);
    });
    Sum total{};
    for (const Sum& sum : sums) total += sum;
    return total;
}

/// Whether lane i of two tiles holds the same answer, bit for bit.
template <typename Real>
bool same_answer(const RayTile<Real>& a, const RayTile<Real>& b, std::size_t i)
{
    if (a.primitive[i] != b.primitive[i]) return false;
    return a.primitive[i] == no_primitive || (a.t_max[i] == b.t_max[i] && a.u[i] == b.u[i] && a.v[i] == b.v[i]);
}

/// How answers compare with the list's.
struct Agreement {
    std::uint64_t rays = 0, hits = 0, different = 0;
    std::uint64_t not_numbers = 0;  ///< NaN or infinite t, u or v of a hit
    Agreement& operator+=(const Agreement& other)
    {
        rays += other.rays, hits += other.hits;
        different += other.different, not_numbers += other.not_numbers;
        return *this;
    }
};

/// Adds what a strategy finds, closest and occluded, beside what the list found.
/// fresh  the rays before the search
template <typename Real>
Agreement agreement(const Strategy<Real>& strategy, const RayTile<Real>& fresh, const RayTile<Real>& expected)
{
    Agreement sum;
    const auto found = std::make_unique<RayTile<Real>>(fresh), any = std::make_unique<RayTile<Real>>(fresh);
    strategy.closest(*found);
    strategy.occluded(*any);
    sum.rays = static_cast<std::uint64_t>(fresh.count);
    for (std::size_t i = 0; i < sum.rays; ++i) {
        const bool hit = expected.primitive[i] != no_primitive;
        sum.hits += hit;
        sum.different += !same_answer(expected, *found, i) || hit != (any->primitive[i] != no_primitive);
        if (found->primitive[i] == no_primitive) continue;
        sum.not_numbers +=
            !(std::isfinite(found->t_max[i]) && std::isfinite(found->u[i]) && std::isfinite(found->v[i]));
    }
    return sum;
}

/// Compares every strategy of ours with the list on batches of rays; masks take turns. Peers count where they hit or
/// miss otherwise.
template <typename Real, typename Make>
std::vector<Agreement> agreements(const Executor& executor, const std::vector<Contender<Real>>& all,
                                  std::uint64_t batches, const Make& make)
{
    std::vector<std::vector<Agreement>> sums(batches, std::vector<Agreement>(all.size()));
    executor.for_each(batches, [&](std::size_t batch) {
        const RayMask mask = batch % 5 == 3 ? RayMask::opaque : batch % 5 == 4 ? RayMask::transmitting : RayMask::all;
        const auto fresh = test::make_tile<Real>(make(batch), 0, mask),
                   expected = std::make_unique<RayTile<Real>>(*fresh);
        all[0].strategy->closest(*expected);
        for (std::size_t i = 0; i < all.size(); ++i) sums[batch][i] = agreement(*all[i].strategy, *fresh, *expected);
    });
    std::vector<Agreement> total(all.size());
    for (const std::vector<Agreement>& sum : sums)
        for (std::size_t i = 0; i < all.size(); ++i) total[i] += sum[i];
    return total;
}

/// Compares all strategies of ours with the list in one precision; returns what all of them sum to.
template <typename Make>
Agreement ours_against_list(const Executor& executor, const Scene& scene, const Pose& now, StrategyOptions options,
                            std::uint64_t batches, const Make& make)
{
    Agreement sum;
    in_type_of(options.precision, [&](auto real) {
        const auto all = contenders<decltype(real)>(scene, now, options, false);
        const std::vector<Agreement> found = agreements(executor, all, batches, make);
        for (const Agreement& one : found) sum += one;
    });
    return sum;
}

}  // namespace firstray::matrix
