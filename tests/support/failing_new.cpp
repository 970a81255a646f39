#include "tests/support/failing_new.h"

#include <dlfcn.h>
#include <execinfo.h>

#include <array>
#include <atomic>
#include <cstring>

#include "bench/firstray/counted_new.h"

namespace firstray::test {
namespace {

std::atomic<std::int64_t> allocations_left{0};
std::atomic<bool> spared{false};
thread_local bool is_watched = false;

bool is_called_by_oiio()
{
    std::array<void*, 64> frames;
    const int count = backtrace(frames.data(), static_cast<int>(frames.size()));
    for (int i = 0; i < count; ++i) {
        Dl_info info{};
        if (dladdr(frames[static_cast<std::size_t>(i)], &info) != 0 && info.dli_fname != nullptr &&
            std::strstr(info.dli_fname, "libOpenImageIO") != nullptr)
            return true;
    }
    return false;
}

/// Whether this is the allocation that the count reaches 0 at; it goes on below, where none fails any more.
bool is_the_one()
{
    if (allocations_left.fetch_sub(1, std::memory_order_relaxed) != 0) return false;
    spared = is_called_by_oiio();
    return !spared;
}

bool is_the_one_here()
{
    return is_watched && is_the_one();
}

}  // namespace

FailingNew::FailingNew(std::int64_t number, Allocations whose)
{
    std::array<void*, 1> first;
    backtrace(first.data(), 1);  // the first call of all allocates
    allocations_left = number;
    spared = false;
    is_watched = true;
    command::fails_allocation = whose == Allocations::of_this_thread ? &is_the_one_here : &is_the_one;
}

FailingNew::~FailingNew()
{
    command::fails_allocation = nullptr;
    is_watched = false;
}

bool FailingNew::was_spared() const
{
    return spared;
}

bool FailingNew::has_failed() const
{
    return allocations_left < 0;
}

}  // namespace firstray::test
