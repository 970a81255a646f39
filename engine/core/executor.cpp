#include "engine/core/executor.h"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <optional>

namespace firstray {

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

}  // namespace firstray
