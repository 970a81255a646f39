#include "tests/support/failing_new.h"

#include <atomic>

#include "bench/firstray/counted_new.h"

namespace firstray::test {
namespace {

std::atomic<std::int64_t> allocations_left{0};
thread_local bool is_watched = false;

/// Whether this is the allocation that the count reaches 0 at; it goes on below, where none fails any more.
bool is_the_one()
{
    return allocations_left.fetch_sub(1, std::memory_order_relaxed) == 0;
}

bool is_the_one_here()
{
    return is_watched && is_the_one();
}

}  // namespace

FailingNew::FailingNew(std::int64_t number, Allocations whose)
{
    allocations_left = number;
    is_watched = true;
    command::fails_allocation = whose == Allocations::of_this_thread ? &is_the_one_here : &is_the_one;
}

FailingNew::~FailingNew()
{
    command::fails_allocation = nullptr;
    is_watched = false;
}

bool FailingNew::has_failed() const
{
    return allocations_left < 0;
}

}  // namespace firstray::test
