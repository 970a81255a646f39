#include "bench/compare/sweep.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <span>

#include "bench/compare/results.h"
#include "engine/render/frameless.h"

namespace firstray::compare {
namespace {

constexpr std::size_t most_frames = 2;
constexpr int rounds = 3;
constexpr int compared_frames = 4;      // at the end of a frameless run
constexpr double frameless_work = 0.5;  // a frame's, some of them whole

/// Positions among the plan's frames.
std::vector<std::size_t> some_frames(std::size_t all)
{
    std::vector<std::size_t> some;
    const std::size_t count = std::min(all, most_frames);
    for (std::size_t i = 0; i < count; ++i) some.push_back((2 * i + 1) * all / (2 * count));
    return some;
}

std::set<int> shares_of(const Plan& plan)
{
    std::set<int> shares = {1, 4, 16, 64};
    shares.insert(plan.frameless.begin(), plan.frameless.end());
    return shares;
}

/// A step's work on all threads: frames of all shares.
double work_shared(const Plan& plan)
{
    double frames = 0.0;
    for (const int turns : shares_of(plan)) frames += 1.0 / turns;
    return frames * static_cast<double>(std::min(plan.frames.size(), most_frames));
}

/// Likewise on one, searching alone included.
double work_alone(const Plan& plan, int threads)
{
    return threads * (work_shared(plan) + static_cast<double>(std::min(plan.frames.size(), most_frames)));
}

/// Which point: threads, and pixels dealt out into how many turns.
struct Setting {
    int threads, turns;
    auto operator<=>(const Setting&) const = default;
};

/// What a setting took in a round, added up over frames.
struct Sum {
    double update_ms = 0.0, trace_ms = 0.0, build_ms = 0.0, rays = 0.0;
};

/// One contestant on one thread and on all.
struct Pair {
    std::string name;
    std::unique_ptr<Contender> alone;
    Contender* shared = nullptr;
    std::map<Setting, std::vector<Sum>> rounds{};
    ByKind<std::vector<double>> ns_per_ray{};  // by round: searching alone, on one thread
};

class Sweep {
public:
    explicit Sweep(Contest& contest) : contest_(contest), frames_(some_frames(contest.frames().size())), alone_(1)
    {
        const RenderOptions& options = contest.plan().render;
        for (const int turns : shares_of(contest.plan()))
            turns_.emplace_back(options.width, options.height, turns, contest.plan().seed);
        contest.for_each([&](const Row& row, Contender& contender) {
            auto alone = std::make_unique<Contender>(contest.scene(), contest.textures(), row.contestant,
                                                     contest.plan().options, alone_);
            pairs_.push_back({row.contestant.name, std::move(alone), &contender});
        });
    }

    void run()
    {
        const std::size_t arms = contest_.executor().threads() > 1 ? 2 : 1;
        for (; rounds_done_ < rounds; ++rounds_done_)
            for (Pair& pair : pairs_) {
                time(pair, *pair.alone, 1, rounds_done_);
                if (arms == 2) time(pair, *pair.shared, contest_.executor().threads(), rounds_done_);
            }
    }

    int rounds_done() const { return rounds_done_; }

    Json to_json() const
    {
        Json frames = Json::array();
        for (const std::size_t f : frames_) frames.push_back(contest_.frames()[f].frame);
        Json json = {{"frames", frames}, {"strategies", Json::array()}};
        for (const Pair& pair : pairs_) {
            Json points = Json::array(), ns = Json::object();
            for (const auto& [setting, sums] : pair.rounds) points.push_back(point(setting, sums));
            for (std::size_t kind = 0; kind < ray_kinds; ++kind)
                ns[name_of(static_cast<RayKind>(kind))] = quantile(pair.ns_per_ray[kind], 0.0);
            json["strategies"].push_back({{"name", pair.name}, {"points", points}, {"ns_per_ray", ns}});
        }
        return json;
    }

private:
    /// Frame after frame for each share, so that an update comes from another frame where there are several, and what
    /// a strategy remembers of the last frame is as many rays.
    void time(Pair& pair, Contender& contender, int threads, int round)
    {
        const double work =
            threads == 1 ? work_alone(contest_.plan(), contest_.executor().threads()) : work_shared(contest_.plan());
        contest_.watch().step(fmt::format("rays and threads, round {}: {} on {}", round + 1, pair.name, threads), work);
        const RenderOptions& options = contest_.plan().render;
        for (const FramelessTurns& turns : turns_) {  // one turn is all pixels, in the order of the shares
            prepare(options);
            std::vector<Sum>& sums = pair.rounds[{threads, static_cast<int>(turns.count())}];
            sums.resize(static_cast<std::size_t>(round) + 1);
            ByKind<double> seconds{}, rays{};
            for (const std::size_t f : frames_) {
                const int frame = contest_.frames()[f].frame;
                const auto pixels = turns.pixels(static_cast<std::size_t>(round));
                const FrameStats stats = contender.render_part(frame, options, pixels, picture_);
                if (threads == 1 && turns.count() == 1) add_search(contender, f, seconds, rays);
                sums.back().update_ms += stats.update_ms;
                sums.back().trace_ms += stats.trace_ms;
                sums.back().build_ms += stats.structure.lazy_build_ms;
                sums.back().rays += static_cast<double>(stats.rays.primary);
            }
            for (std::size_t kind = 0; kind < ray_kinds; ++kind)
                if (rays[kind] > 0.0) pair.ns_per_ray[kind].push_back(1e9 * seconds[kind] / rays[kind]);
        }
    }

    /// The frame's rays asked again of the structure alone.
    void add_search(const Contender& contender, std::size_t f, ByKind<double>& seconds, ByKind<double>& rays) const
    {
        const ByKind<double> spent = contender.replay(contest_.recorded(f));
        for (std::size_t kind = 0; kind < ray_kinds; ++kind) {
            seconds[kind] += spent[kind];
            rays[kind] += static_cast<double>(contest_.frames()[f].kept[kind]);
        }
    }

    /// A picture that render_pixels takes for a former one.
    void prepare(const RenderOptions& options)
    {
        picture_.width = options.width;
        picture_.height = options.height;
        const std::size_t pixels = picture_.pixel_count();
        picture_.colour.resize(pixels);
        picture_.distance.resize(pixels);
        picture_.primitive.resize(pixels);
        picture_.group.resize(pixels);
        picture_.age.resize(pixels);
    }

    Json point(const Setting& setting, const std::vector<Sum>& sums) const
    {
        const auto least = [&](double Sum::*part) {
            std::vector<double> values;
            for (const Sum& sum : std::span(sums).first(static_cast<std::size_t>(rounds_done_)))
                values.push_back(sum.*part / static_cast<double>(frames_.size()));
            return *std::min_element(values.begin(), values.end());
        };
        return {{"threads", setting.threads},        {"turns", setting.turns},
                {"rays", least(&Sum::rays)},         {"update_ms", least(&Sum::update_ms)},
                {"trace_ms", least(&Sum::trace_ms)}, {"build_ms", least(&Sum::build_ms)}};
    }

    Contest& contest_;
    std::vector<std::size_t> frames_;
    Executor alone_;
    std::vector<FramelessTurns> turns_;
    std::vector<Pair> pairs_;
    int rounds_done_ = 0;
    Frame picture_;
};

/// Frames in a row that end near the middle of what the plan looks at.
std::vector<int> row_of_frames(const Contest& contest, int turns)
{
    const int all = contest.scene().frames;
    const int count = std::min(all, turns + compared_frames);
    const int middle = contest.plan().frames[contest.plan().frames.size() / 2];
    const int first = std::clamp(middle - count / 2, 0, all - count);
    std::vector<int> frames(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) frames[static_cast<std::size_t>(i)] = first + i;
    return frames;
}

Json frameless_error(Contest& contest, Contender& contender, int turns)
{
    const Plan& plan = contest.plan();
    const std::vector<int> frames = row_of_frames(contest, turns);
    const FramelessTurns deal(plan.render.width, plan.render.height, turns, plan.seed);
    const std::size_t compared = std::min<std::size_t>(frames.size(), compared_frames);
    Frame picture, whole;
    ImageError sum;
    double worst = 0.0;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        contest.watch().step(fmt::format("frameless 1/{}: frame {}", turns, frames[i]), frameless_work);
        if (i == 0)
            contender.render(frames[i], plan.render, picture);
        else
            contender.render_part(frames[i], plan.render, deal.pixels(i - 1), picture);
        if (i + compared < frames.size()) continue;
        contender.render(frames[i], plan.render, whole);
        const ImageError error = image_error(whole, picture);
        worst = std::max(worst, error.rmse());
        sum += error;
    }
    const std::vector<int> looked_at(frames.end() - static_cast<std::ptrdiff_t>(compared), frames.end());
    return {{"turns", turns},
            {"frames", looked_at},
            {"is_refreshed", static_cast<int>(frames.size() - compared) >= turns},
            {"image", to_json(sum)},
            {"worst_rmse", worst}};
}

}  // namespace

double sweep_work(const Contest& contest)
{
    const int threads = contest.executor().threads();
    const double shared = threads > 1 ? work_shared(contest.plan()) : 0.0;
    return static_cast<double>(contest.rows().size()) * rounds * (work_alone(contest.plan(), threads) + shared);
}

double frameless_work_of(const Contest& contest)
{
    double frames = 0.0;
    for (const int turns : contest.plan().frameless)
        frames += static_cast<double>(row_of_frames(contest, turns).size());
    return frames * frameless_work;
}

void measure_sweep(Contest& contest, Json& into)
{
    Sweep sweep(contest);
    run_and_keep(sweep, into);
}

void measure_frameless(Contest& contest, Json& into)
{
    const Plan& plan = contest.plan();
    contest.for_each([&](const Row& row, Contender& contender) {
        if (!into.is_null() || row.contestant.entry->peer) return;
        into = Json::array();
        for (const int turns : plan.frameless) into.push_back(frameless_error(contest, contender, turns));
    });
}

}  // namespace firstray::compare
