#include "bench/compare/trade.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "bench/compare/results.h"
#include "engine/render/frameless.h"

namespace firstray::compare {
namespace {

constexpr int full_samples = 16;
constexpr int most_rounds = 3;
constexpr std::size_t most_frames = 2;

/// Positions among the plan's frames.
std::vector<std::size_t> chosen_frames(const Contest& contest)
{
    const std::size_t all = contest.frames().size(), count = std::min(all, most_frames);
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < count; ++i) chosen.push_back((2 * i + 1) * all / (2 * count));
    return chosen;
}

int rounds_of(const Plan& plan)
{
    return std::min(plan.repeat, most_rounds);
}

/// Of one step, see Watch: frameless frames come after a whole one and as many parts as make another.
double work_of(const TradeSetting& setting)
{
    const double frames = setting.turns > 1 ? 2.0 : 1.0;
    return frames * setting.render.samples * (setting.options.precision == Precision::double_ ? 2.0 : 1.0);
}

/// A setting at work.
struct Entry {
    TradeSetting setting;
    std::unique_ptr<Contender> contender{};
    std::string fault{};
    ImageError error{};
    HitAgreement hits{};
    std::vector<FrameStats> sums{};  ///< by round: times added up over frames
};

class Trade {
public:
    Trade(Contest& contest, const Contestant& contestant)
        : contest_(contest), contestant_(contestant), frames_(chosen_frames(contest))
    {
        reference_ = setting_of(parse_contestant("grid"));
        truth_ = std::make_unique<Contender>(contest.scene(), contest.textures(), parse_contestant("list"),
                                             reference_.options, contest.executor());
        for (TradeSetting& setting : trade_settings(contest.plan(), contestant))
            entries_.push_back({std::move(setting)});
        for (Entry& entry : entries_)
            attempt(entry, [&] { entry.contender = make(entry.setting.contestant, entry.setting.options); });
    }

    void run()
    {
        for (const std::size_t f : frames_) check(f);
        for (; rounds_done_ < rounds_of(contest_.plan()); ++rounds_done_)
            for (const std::size_t f : frames_)
                for (Entry& entry : entries_)
                    attempt(entry, [&] { time(entry, f, static_cast<std::size_t>(rounds_done_)); });
    }

    int rounds_done() const { return rounds_done_; }

    Json to_json() const
    {
        Json frames = Json::array(), settings = Json::array();
        for (const std::size_t f : frames_) frames.push_back(contest_.frames()[f].frame);
        std::uint64_t rays = 0;
        for (const Entry& entry : entries_) {
            settings.push_back(json_of(entry));
            rays = std::max(rays, entry.hits.rays);
        }
        judge(settings);
        return {{"strategy", contestant_.name},
                {"reference", fmt::format("double, depth {}, {} samples, whole frames", reference_.render.depth,
                                          reference_.render.samples)},
                {"frames", frames},
                {"rays", rays},
                {"settings", settings}};
    }

private:
    std::unique_ptr<Contender> make(const Contestant& contestant, const StrategyOptions& options) const
    {
        return std::make_unique<Contender>(contest_.scene(), contest_.textures(), contestant, options,
                                           contest_.executor());
    }

    TradeSetting setting_of(const Contestant& contestant) const
    {
        const Plan& plan = contest_.plan();
        TradeSetting setting{"reference", contestant, plan.options, plan.render};
        setting.options.precision = Precision::double_;
        setting.render.depth = std::max(trade_depth, plan.render.depth);
        setting.render.samples = std::max(full_samples, plan.render.samples);
        return setting;
    }

    template <typename Work>
    static void attempt(Entry& entry, const Work& work)
    {
        if (!entry.fault.empty()) return;
        try {
            work();
        } catch (const Interrupted&) {
            throw;
        } catch (const std::exception& error) {
            entry.fault = error.what();
        }
    }

    /// Compares everyone's picture and hits with the reference's.
    void check(std::size_t f)
    {
        const int frame = contest_.frames()[f].frame;
        Frame expected;
        const std::unique_ptr<Contender> reference = make(reference_.contestant, reference_.options);
        reference->render(frame, reference_.render, expected);
        const RecordedRays& rays = contest_.recorded(f);
        const Sample sample = contest_.sample_of(rays);
        truth_->update(frame);
        const std::vector<RayAnswer> truth = truth_->sparse_answers(rays, sample);
        for (Entry& entry : entries_)
            attempt(entry, [&] {
                contest_.watch().step(fmt::format("trade, frame {}: {}", frame, entry.setting.name),
                                      work_of(entry.setting));
                entry.error += image_error(expected, picture_at(entry, frame));
                entry.hits += agreement(truth, entry.contender->answers(rays, sample));
            });
    }

    /// Frameless: after as many frames as there are turns, where there are so many.
    const Frame& picture_at(Entry& entry, int frame)
    {
        const TradeSetting& setting = entry.setting;
        const FramelessTurns turns(setting.render.width, setting.render.height, setting.turns, contest_.plan().seed);
        const int first = setting.turns == 1 ? frame : std::max(0, frame - setting.turns);
        entry.contender->render(first, setting.render, picture_);
        for (int f = first + 1; f <= frame; ++f)
            entry.contender->render_part(f, setting.render, turns.pixels(static_cast<std::size_t>(f)), picture_);
        return picture_;
    }

    void time(Entry& entry, std::size_t f, std::size_t round)
    {
        const TradeSetting& setting = entry.setting;
        const int frame = contest_.frames()[f].frame;
        contest_.watch().step(fmt::format("trade, round {}, frame {}: {}", round + 1, frame, setting.name),
                              work_of(setting));
        if (setting.turns > 1) picture_at(entry, std::max(0, frame - 1));
        const FramelessTurns turns(setting.render.width, setting.render.height, setting.turns, contest_.plan().seed);
        const FrameStats stats =
            setting.turns == 1 ? entry.contender->render(frame, setting.render, picture_)
                               : entry.contender->render_part(frame, setting.render,
                                                              turns.pixels(static_cast<std::size_t>(frame)), picture_);
        entry.sums.resize(round + 1);
        entry.sums[round].update_ms += stats.update_ms / static_cast<double>(frames_.size());
        entry.sums[round].trace_ms += stats.trace_ms / static_cast<double>(frames_.size());
        entry.sums[round].structure = stats.structure;
    }

    Json json_of(const Entry& entry) const
    {
        Json json = {{"name", entry.setting.name},
                     {"fault", entry.fault},
                     {"is_orientation", entry.setting.is_orientation},
                     {"on_frontier", false},
                     {"worse_than", ""}};
        if (!entry.fault.empty()) return json;
        std::vector<double> update, trace, total;
        const auto rounds = std::span(entry.sums).first(static_cast<std::size_t>(rounds_done_));
        for (const FrameStats& sum : rounds) {
            update.push_back(sum.update_ms);
            trace.push_back(sum.trace_ms);
            total.push_back(sum.total_ms());
        }
        json["update_ms"] = compare::to_json(spread_of(update));
        json["trace_ms"] = compare::to_json(spread_of(trace));
        json["total_ms"] = compare::to_json(spread_of(total));
        json["totals"] = total;
        json["image"] = compare::to_json(entry.error);
        json["hits"] = {{"rays", entry.hits.rays},
                        {"missed_per_million", entry.hits.per_million(entry.hits.missed)},
                        {"false_per_million", entry.hits.per_million(entry.hits.invented)},
                        {"t_error_p999", quantile(entry.hits.t_errors, 0.999)}};
        json["bytes"] = rounds.back().structure.bytes;
        return json;
    }

    Contest& contest_;
    Contestant contestant_;
    std::vector<std::size_t> frames_;
    TradeSetting reference_;
    std::unique_ptr<Contender> truth_;
    std::vector<Entry> entries_;
    int rounds_done_ = 0;
    Frame picture_;
};

}  // namespace

double trade_work(const Plan& plan)
{
    double work = 0.0;
    for (const TradeSetting& setting : trade_settings(plan, parse_contestant("grid"))) work += work_of(setting);
    return static_cast<double>(std::min(plan.frames.size(), most_frames)) * (1 + rounds_of(plan)) * work;
}

void measure_trade(Contest& contest, const Contestant& contestant, Json& into)
{
    Trade trade(contest, contestant);
    run_and_keep(trade, into);
}

}  // namespace firstray::compare
