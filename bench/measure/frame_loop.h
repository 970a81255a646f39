#pragma once
#include <array>
#include <span>

#include "bench/measure/frame_stats.h"
#include "bench/measure/stopwatch.h"
#include "engine/render/render.h"
#include "engine/scene/pose.h"
#include "engine/strategy/strategy.h"

namespace firstray {

/// Everything that renders frame after frame, whichever the arithmetic.
template <typename Real>
class FrameLoop {
public:
    /// All must outlive the loop.
    FrameLoop(const Scene& scene, std::span<const Texture> textures, Strategy<Real>& strategy, const Executor& executor)
        : scene_(scene), textures_(textures), strategy_(strategy), executor_(executor)
    {
    }

    /// Poses the scene and brings the structure there, no more.
    FrameStats update(int frame)
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
        return stats;
    }

    /// Fills `picture` and returns what it took.
    FrameStats render(int frame, const RenderOptions& options, Frame& picture)
    {
        return finish(update(frame), picture, [&](const Pose& pose) {
            return firstray::render(strategy_, pose, textures_, options, executor_, picture);
        });
    }

    /// Traces some pixels alone.
    /// picture  as a frame of the same options left it
    FrameStats render_part(int frame, const RenderOptions& options, std::span<const glm::ivec2> pixels, Frame& picture)
    {
        return finish(update(frame), picture, [&](const Pose& pose) {
            return render_pixels(strategy_, pose, textures_, options, executor_, pixels, picture);
        });
    }

    const Pose& current_pose() const { return poses_[current_]; }
    /// Of the structure as the last frame left it.
    std::vector<StructureBox> outline() const { return strategy_.outline(); }

private:
    template <typename Trace>
    FrameStats finish(FrameStats stats, const Frame& picture, const Trace& trace)
    {
        const Stopwatch tracing;
        stats.rays = trace(poses_[current_]);
        stats.trace_ms = tracing.ms();
        stats.structure = strategy_.report();
        stats.image_hash = image_hash(picture);
        return stats;
    }

    const Scene& scene_;
    std::span<const Texture> textures_;
    Strategy<Real>& strategy_;
    const Executor& executor_;
    std::array<Pose, 2> poses_;
    std::size_t current_ = 0;
};

}  // namespace firstray
