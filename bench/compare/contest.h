#pragma once
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/compare/contender.h"
#include "bench/compare/image_error.h"
#include "bench/compare/plan.h"

namespace firstray::compare {

/// One timed frame of one contestant.
struct FrameSample {
    FrameStats stats;
    ByKind<double> ns_per_ray{};  ///< searching alone, thread time
};

/// What was learnt of a contestant; what is by frame is in the order of Plan::frames.
struct Row {
    Contestant contestant;
    std::string fault;                             ///< why it is out; empty while it is not
    HitAgreement hits;                             ///< with `list`, of all frames
    std::vector<ImageError> errors;                ///< by frame, against the reference's picture
    std::vector<std::vector<FrameSample>> rounds;  ///< [round][frame]
};

/// What all contestants were asked in a frame.
struct FrameFacts {
    int frame = 0;
    RayCounts rays;
    ByKind<std::uint64_t> asked{}, kept{};  ///< rays by kind, and those that are replayed
};

/// Strategies that take turns, frame by frame.
class Contest {
public:
    /// All must outlive the contest. A contestant that cannot be made is out.
    /// throws  what the reference throws
    Contest(const Scene& scene, std::span<const Texture> textures, const Plan& plan, const Watch& watch);

    /// What check() and measure() come to; see Watch.
    double work() const;

    /// Records the rays of all frames and compares everyone's answers and pictures with the reference's. Warms up.
    void check();

    /// Times Plan::repeat rounds through all frames. Contestants take turns frame by frame, so that a machine that
    /// speeds up or slows down does so for all, and none always follows the same; rounds follow the animation, so that
    /// an update comes from another frame where there are several.
    void measure();

    /// Calls work(row, contender) for everyone who is in; who throws is out. Interrupted passes through.
    template <typename Work>
    void for_each(const Work& work)
    {
        for (std::size_t i = 0; i < rows_.size(); ++i) attempt(i, [&] { work(rows_[i], *contenders_[i]); });
    }

    const Scene& scene() const { return scene_; }
    std::span<const Texture> textures() const { return textures_; }
    const Plan& plan() const { return plan_; }
    const Watch& watch() const { return watch_; }
    const Executor& executor() const { return executor_; }
    const std::vector<Row>& rows() const { return rows_; }
    const std::vector<FrameFacts>& frames() const { return frames_; }  ///< those checked so far
    const RecordedRays& recorded(std::size_t f) const { return rays_[f]; }
    /// The rays of a frame that are compared with `list`.
    Sample sample_of(const RecordedRays& rays) const;
    std::size_t complete_rounds() const { return complete_rounds_; }
    double list_ns_per_ray() const;  ///< thread time that `list` took in check()
    const std::string& reference() const { return reference_name_; }

private:
    template <typename Work>
    void attempt(std::size_t i, const Work& work);
    void check_frame(std::size_t f);
    void measure_frame(std::size_t f, std::size_t round);

    const Scene& scene_;
    std::span<const Texture> textures_;
    const Plan& plan_;
    const Watch& watch_;
    Executor executor_, alone_;
    std::string reference_name_;
    std::unique_ptr<Contender> reference_, list_;
    std::vector<Row> rows_;
    std::vector<std::unique_ptr<Contender>> contenders_;  // null: out
    std::vector<FrameFacts> frames_;
    std::vector<RecordedRays> rays_;  // by frame
    std::size_t complete_rounds_ = 0;
    double list_seconds_ = 0.0;
    std::uint64_t list_rays_ = 0;
};

/// The rule for Plan::check_rays: so many that testing all of a scene's primitives takes about a third of a second.
std::size_t default_check_rays(std::size_t primitives);

template <typename Work>
void Contest::attempt(std::size_t i, const Work& work)
{
    if (!contenders_[i]) return;
    try {
        return work();
    } catch (const Interrupted&) {
        throw;
    } catch (const std::bad_alloc&) {
        rows_[i].fault = "out of memory";
    } catch (const std::exception& error) {
        rows_[i].fault = error.what();
    }
    contenders_[i].reset();
}

/// Runs a further part of the comparison, and keeps what it measured in whole rounds when it is interrupted.
/// part    `run()`, `rounds_done()`, `to_json()` of these rounds
/// throws  Interrupted
template <class Part>
void run_and_keep(Part& part, Json& into)
{
    try {
        part.run();
    } catch (const Interrupted&) {
        if (part.rounds_done() > 0) into = part.to_json();
        throw;
    }
    into = part.to_json();
}

}  // namespace firstray::compare
