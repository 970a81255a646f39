#include "bench/firstray/interrupt.h"

#include <atomic>

namespace firstray::command {
namespace {

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);  // as a signal handler needs it

}  // namespace

InterruptGuard::InterruptGuard()
{
    interrupted = false;
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted.store(true, std::memory_order_relaxed); };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &former_int_);
    sigaction(SIGTERM, &action, &former_term_);
}

InterruptGuard::~InterruptGuard()
{
    sigaction(SIGINT, &former_int_, nullptr);
    sigaction(SIGTERM, &former_term_, nullptr);
}

bool InterruptGuard::is_interrupted()
{
    return interrupted.load(std::memory_order_relaxed);
}

}  // namespace firstray::command
