#pragma once
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "bench/compare/hit_check.h"
#include "bench/measure/contestant.h"
#include "bench/measure/frame_loop.h"
#include "bench/measure/recorded_rays.h"

namespace firstray::compare {

/// A strategy at work, in whatever arithmetic its options ask for.
class Contender {
public:
    /// All but `contestant` must outlive the contender.
    /// throws  Error where the strategy does not have the precision; what making it throws
    Contender(const Scene& scene, std::span<const Texture> textures, const Contestant& contestant,
              StrategyOptions options, const Executor& executor);

    /// See FrameLoop.
    void update(int frame);
    FrameStats render(int frame, const RenderOptions& options, Frame& picture);
    FrameStats render_part(int frame, const RenderOptions& options, std::span<const glm::ivec2> pixels, Frame& picture);
    const Pose& current_pose() const;
    std::vector<StructureBox> outline() const;

    /// Renders and writes down the rays; for a contender that was made with an executor of one thread, so that they
    /// come in the same order every time.
    FrameStats record(int frame, const RenderOptions& options, Frame& picture, RecordedRays& rays);

    /// Asks all recorded rays again, as the structure stands.
    /// returns  by kind: seconds spent searching, added up over threads
    ByKind<double> replay(const RecordedRays& rays) const;

    /// See hit_check.h.
    std::vector<RayAnswer> answers(const RecordedRays& rays, Sample sample) const;
    std::vector<RayAnswer> sparse_answers(const RecordedRays& rays, Sample sample) const;

private:
    template <typename Real>
    struct Made {
        std::unique_ptr<Strategy<Real>> strategy;
        std::unique_ptr<RayRecorder<Real>> recorder;
        std::unique_ptr<FrameLoop<Real>> loop, recording_loop;
    };
    using Any = std::variant<Made<float>, Made<double>>;

    template <typename Real>
    static Made<Real> made(const Scene& scene, std::span<const Texture> textures,
                           std::unique_ptr<Strategy<Real>> strategy, const Executor& executor);

    const Executor& executor_;
    Any any_;
};

}  // namespace firstray::compare
