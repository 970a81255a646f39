#include "engine/core/executor.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

// ThreadSanitizer does not see how TBB, which is not built with it, hands work over: it would report every loop.
#if defined(__SANITIZE_THREAD__)
#define FIRSTRAY_PLAIN_THREADS 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define FIRSTRAY_PLAIN_THREADS 1
#endif
#endif

namespace firstray::inline v0 {
namespace {

/// A loop on threads that are made for it.
[[maybe_unused]] void loop_on_threads(int threads, std::size_t count, const std::function<void(std::size_t)>& body)
{
    std::atomic<std::size_t> next{0};
    std::mutex mutex;
    std::exception_ptr fault;
    const auto work = [&] {
        try {
            for (std::size_t i; (i = next.fetch_add(1)) < count;) body(i);
        } catch (...) {
            next = count;
            const std::lock_guard lock(mutex);
            if (!fault) fault = std::current_exception();
        }
    };
    std::vector<std::thread> crew;
    for (int i = 1; i < threads; ++i) crew.emplace_back(work);
    work();
    for (std::thread& thread : crew) thread.join();
    if (fault) std::rethrow_exception(fault);
}

}  // namespace

struct Executor::Arena {
    explicit Arena(int threads) : arena(threads)
    {
        // More threads than processors are had only when TBB is told so; the allowance lasts as long as this executor.
        using oneapi::tbb::global_control;
        const auto wanted = static_cast<std::size_t>(threads);
        if (wanted > global_control::active_value(global_control::max_allowed_parallelism))
            allowance.emplace(global_control::max_allowed_parallelism, wanted);
    }
    std::optional<oneapi::tbb::global_control> allowance;
    oneapi::tbb::task_arena arena;
};

Executor::Executor(int threads)
    : threads_(threads > 0 ? threads : std::max(1, oneapi::tbb::info::default_concurrency())),
      arena_(std::make_unique<Arena>(threads_))
{
}

Executor::~Executor() = default;

void Executor::for_each(std::size_t count, const std::function<void(std::size_t)>& body) const
{
    if (threads_ == 1 || count <= 1) {
        for (std::size_t i = 0; i < count; ++i) body(i);
        return;
    }
#ifdef FIRSTRAY_PLAIN_THREADS
    return loop_on_threads(threads_, count, body);
#endif
    arena_->arena.execute(
        [&] { oneapi::tbb::parallel_for(std::size_t{0}, count, body, oneapi::tbb::simple_partitioner{}); });
}

void Executor::for_pieces(std::size_t count, std::size_t grain,
                          const std::function<void(std::size_t, std::size_t)>& body) const
{
    grain = std::max<std::size_t>(grain, 1);
    for_each((count + grain - 1) / grain,
             [&](std::size_t piece) { body(piece * grain, std::min(count, (piece + 1) * grain)); });
}

void for_pieces(const Executor* executor, std::size_t count, std::size_t grain,
                const std::function<void(std::size_t, std::size_t)>& body)
{
    if (executor)
        executor->for_pieces(count, grain, body);
    else if (count > 0)
        body(0, count);
}

}  // namespace firstray::inline v0
