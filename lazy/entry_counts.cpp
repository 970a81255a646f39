#include "lazy/entry_counts.h"

namespace firstray::inline v0::lazy {
namespace {

constexpr std::size_t per_line = 64 / sizeof(std::atomic<std::uint64_t>);

std::uint64_t next_number()
{
    static std::atomic<std::uint64_t> last{0};
    return ++last;
}

}  // namespace

EntryCounts::EntryCounts(std::size_t places) : places_(places), number_(next_number()) {}

/// An id comes back only after its thread has ended; whoever has it then goes on with that thread's counters.
std::atomic<std::uint64_t>* EntryCounts::find_or_register()
{
    const std::lock_guard lock(mutex_);
    Counters& counters = counters_[std::this_thread::get_id()];
    // A cache line of nothing on both sides keeps what the allocator puts beside them from being shared.
    if (!counters) counters = std::make_unique<std::atomic<std::uint64_t>[]>(places_ + 2 * per_line);
    last_used_ = {number_, counters.get() + per_line};
    return last_used_.counters;
}

std::uint64_t EntryCounts::total(std::size_t place) const
{
    const std::lock_guard lock(mutex_);
    std::uint64_t sum = 0;
    for (const auto& [thread, counters] : counters_) sum += counters[per_line + place].load(std::memory_order_relaxed);
    return sum;
}

void EntryCounts::clear(std::size_t place)
{
    for (const auto& [thread, counters] : counters_) counters[per_line + place].store(0, std::memory_order_relaxed);
}

std::uint64_t EntryCounts::bytes() const
{
    return counters_.size() * (places_ + 2 * per_line) * sizeof(std::atomic<std::uint64_t>);
}

}  // namespace firstray::inline v0::lazy
