#pragma once
#include <array>
#include <chrono>
#include <span>

#include "bench/firstray/stats.h"
#include "engine/render/render.h"
#include "engine/scene/pose.h"
#include "engine/strategy/strategy.h"

namespace firstray::command {

class Stopwatch {
public:
    double ms() const { return std::chrono::duration<double, std::milli>(Clock::now() - start_).count(); }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

/// Everything that renders frame after frame, whichever the arithmetic.
template <typename Real>
class FrameLoop {
public:
    FrameLoop(const Scene& scene, std::span<const Texture> textures, Strategy<Real>& strategy,
              const RenderOptions& options, const Executor& executor)
        : scene_(scene), textures_(textures), strategy_(strategy), options_(options), executor_(executor)
    {
    }

    /// Fills `picture` and returns what it took.
    FrameStats render(int frame, Frame& picture)
    {
        FrameStats stats;
        stats.frame = frame;
        stats.time = scene_.time_of(frame);
        current_ = 1 - current_;  // the strategy may look at the former pose until it has the new one
        const Stopwatch update;
        poses_[current_] = pose(scene_, stats.time);
        stats.pose_ms = update.ms();
        strategy_.update(poses_[current_]);
        stats.update_ms = update.ms();
        const Stopwatch trace;
        stats.rays = firstray::render(strategy_, poses_[current_], textures_, options_, executor_, picture);
        stats.trace_ms = trace.ms();
        stats.structure = strategy_.report();
        stats.image_hash = image_hash(picture);
        return stats;
    }

    const Pose& current_pose() const { return poses_[current_]; }
    /// Of the structure as the last frame left it.
    std::vector<StructureBox> outline() const { return strategy_.outline(); }

private:
    const Scene& scene_;
    std::span<const Texture> textures_;
    Strategy<Real>& strategy_;
    RenderOptions options_;
    const Executor& executor_;
    std::array<Pose, 2> poses_;
    std::size_t current_ = 0;
};

}  // namespace firstray::command
