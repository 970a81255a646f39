#pragma once
#include <csignal>

namespace firstray::command {

/// Until it goes away, the first SIGINT or SIGTERM is only noted, so that what is finished can be kept; the second ends
/// the program at once.
class InterruptGuard {
public:
    InterruptGuard();
    ~InterruptGuard();
    InterruptGuard(const InterruptGuard&) = delete;
    InterruptGuard& operator=(const InterruptGuard&) = delete;

    /// Whether the guard that lives has noted one. Any thread.
    static bool is_interrupted();

private:
    struct sigaction former_int_ {
    }, former_term_{};
};

}  // namespace firstray::command
