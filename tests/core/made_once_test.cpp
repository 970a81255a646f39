#include "engine/core/made_once.h"

#include <doctest/doctest.h>

#include <array>
#include <barrier>
#include <memory>
#include <vector>

#include "tests/support/crew.h"

using namespace firstray;
using namespace firstray::test;

namespace {

/// Says whether it is whole: half-made ones do not add up.
struct Sealed {
    std::array<std::uint64_t, 24> words{};
    std::uint64_t seal = 0;

    Sealed() = default;  ///< not whole
    /// Gives others a chance to look at the half of it.
    explicit Sealed(std::uint64_t seed)
    {
        for (std::uint64_t& word : words) {
            seal += word = seed += 0x9e3779b97f4a7c15u;
            if (&word == &words[12]) std::this_thread::yield();
        }
    }
    bool is_whole() const
    {
        std::uint64_t sum = 0;
        for (const std::uint64_t word : words) sum += word;
        return sum == seal && seal != 0;
    }
};

/// What one of many threads that ask together got. Nothing that they share would do: it would keep them in order.
struct alignas(64) Tally {
    int made = 0, finished = 0, without = 0, broken = 0, others = 0;

    void count(const Sealed* got, const Sealed* expected)
    {
        broken += got && !got->is_whole();
        others += got && expected && got != expected;
        ++(got ? finished : without);
    }
    void add(const Tally& tally)
    {
        made += tally.made;
        finished += tally.finished;
        without += tally.without;
        broken += tally.broken;
        others += tally.others;
    }
};

}  // namespace

TEST_CASE("of 64 threads that ask together one makes; others get the finished thing or do without")
{
    constexpr int rounds = 10000, threads = 64;
    std::vector<MadeOnce<Sealed>> things(rounds);
    std::vector<Tally> tallies(threads);
    std::barrier<> together(threads);
    Crew(threads).run([&](int thread) {
        Tally& own = tallies[static_cast<std::size_t>(thread)];
        for (std::size_t round = 0; round < rounds; ++round) {
            if (round % 20 == 0) together.arrive_and_wait();  // or one thread makes them all in its slice of time
            const Sealed* const got = things[round].get_or_make([&] {
                ++own.made;
                return std::make_unique<Sealed>(round);
            });
            own.count(got, nullptr);
            const Sealed* later = things[round].get();
            for (; !later; later = things[round].get()) std::this_thread::yield();
            own.count(later, got);
        }
    });
    Tally tally;
    for (const Tally& one : tallies) tally.add(one);
    CHECK(tally.made == rounds);
    CHECK(tally.broken == 0);
    CHECK(tally.others == 0);
    CHECK(tally.finished + tally.without == 2 * rounds * threads);
    for (const auto& thing : things) CHECK(thing.get() != nullptr);
    MESSAGE(rounds << " rounds, " << threads << " threads: " << tally.without << " of " << rounds * threads
                   << " calls did without");
}

TEST_CASE("who asks while it is being made does without")
{
    MadeOnce<Sealed> thing;
    const Sealed* seen = nullptr;
    int made = 0;
    const Sealed* const got = thing.get_or_make([&] {
        ++made;
        const auto again = [&] {
            ++made;
            return std::make_unique<Sealed>(2);
        };
        seen = thing.get_or_make(again);
        Crew(1).run([&](int) { CHECK((!thing.get_or_make(again) && !thing.get())); });
        return std::make_unique<Sealed>(1);
    });
    CHECK(made == 1);
    CHECK(seen == nullptr);
    REQUIRE(got != nullptr);
    CHECK(got == thing.get());
}

TEST_CASE("many threads are refused together, once for all")
{
    constexpr int rounds = 1000;
    std::vector<MadeOnce<Sealed>> things(rounds);
    std::atomic<int> asked{0}, got{0};
    Crew(8).run([&](int) {
        for (auto& thing : things) {
            got += thing.get_or_make([&] {
                ++asked;
                return std::unique_ptr<Sealed>();
            }) != nullptr;
            got += thing.get() != nullptr;
        }
    });
    CHECK(asked == rounds);
    CHECK(got == 0);
}

TEST_CASE("what is taken out, or was refused, can be made again")
{
    int made = 0;
    MadeOnce<Sealed> thing;
    const auto make = [&] {
        ++made;
        return std::make_unique<Sealed>(static_cast<std::uint64_t>(made));
    };
    CHECK(thing.take() == nullptr);
    const Sealed* const first = thing.get_or_make(make);
    CHECK(thing.get_or_make(make) == first);
    const std::unique_ptr<Sealed> taken = thing.take();
    CHECK(taken.get() == first);
    CHECK(thing.get() == nullptr);
    CHECK(thing.take() == nullptr);
    CHECK(made == 1);

    CHECK(thing.get_or_make([] { return std::unique_ptr<Sealed>(); }) == nullptr);
    CHECK(thing.get_or_make(make) == nullptr);
    CHECK(made == 1);
    CHECK(thing.take() == nullptr);
    CHECK(thing.get_or_make(make) != nullptr);
    CHECK(made == 2);
}
