#include "lazy/entry_counts.h"

#include <doctest/doctest.h>

#include <optional>
#include <vector>

#include "tests/support/crew.h"

using namespace firstray;
using lazy::EntryCounts;

TEST_CASE("counters: what eight threads add sums up exactly")
{
    constexpr int threads = 8, places = 33, times = 20000;
    EntryCounts counts(places);
    test::Crew(threads).run([&](int thread) {
        for (int i = 0; i < times; ++i)
            counts.add(static_cast<std::size_t>((i + thread) % places), static_cast<std::uint64_t>(1 + thread));
    });
    std::uint64_t sum = 0;
    for (std::size_t place = 0; place < places; ++place) {
        std::uint64_t expected = 0;
        for (int thread = 0; thread < threads; ++thread)
            for (int i = 0; i < times; ++i)
                expected +=
                    (i + thread) % places == static_cast<int>(place) ? static_cast<std::uint64_t>(1 + thread) : 0;
        CHECK(counts.total(place) == expected);
        sum += counts.total(place);
    }
    CHECK(sum == std::uint64_t{times} * (threads * (threads + 1) / 2));
}

TEST_CASE("counters: a thread sees its own at once, and totals only grow while others count")
{
    EntryCounts counts(1);
    std::atomic<int> wrong{0};
    test::Crew(4).run([&](int) {
        std::uint64_t last = 0;
        for (std::uint64_t i = 1; i <= 2000; ++i) {
            counts.add(0, 1);
            wrong += counts.mine(0) != i;
            const std::uint64_t total = counts.total(0);
            wrong += total < i || total < last;
            last = total;
        }
    });
    CHECK(wrong == 0);
    CHECK(counts.total(0) == 8000);
}

TEST_CASE("counters: those of one owner are never taken for another's")
{
    EntryCounts a(2), b(2);
    for (int i = 0; i < 10; ++i) {  // turn about
        a.add(1, 1);
        b.add(1, 100);
    }
    CHECK(a.total(1) == 10);
    CHECK(b.total(1) == 1000);

    std::optional<EntryCounts> again;
    for (int i = 0; i < 5; ++i) {  // at the same address
        again.emplace(3);
        CHECK(again->mine(2) == 0);
        again->add(2, 7);
        CHECK(again->total(2) == 7);
    }
    a.clear(1);
    CHECK(a.total(1) == 0);
    CHECK(a.mine(1) == 0);
    a.add(1, 3);
    CHECK(a.total(1) == 3);
}
