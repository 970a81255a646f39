// From how many rays a frame on does which structure pay? Plays a few frames in a row with ever larger pictures, from a
// handful of rays to millions, through strategies that begin with nothing, and prints what all frames took together,
// updates and builds included, side by side. Answers are checked first. One thread.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <limits>
#include <optional>

#include "bench/micro/flags.h"
#include "engine/aff/reader.h"
#include "engine/core/errors.h"

namespace firstray {
namespace {

constexpr const char* usage =
    "ray_sweep [--scene=FILE]... [--rays=10,100,...,1000000] [--frames=4] [--rounds=5] [--first=N] [--limit=60]\n"
    "          [--strategies=list,lazy,adaptive] [--csv=FILE]\n"
    "Primary rays of a frame are about as many as asked for; to each that hits comes one shadow ray per light.\n"
    "Frames are in a row from frame N on, by default a third into the animation. What is likely to take more than\n"
    "--limit seconds a round is skipped.\n";

struct Settings {
    std::vector<NamedScene> scenes;
    std::vector<int> rays{10, 100, 1000, 10000, 100000, 1000000};
    std::vector<Contestant> contestants;
    int frames = 4, rounds = 5, first = -1, limit = 60;
    std::string csv;
};

/// What a contestant took at one number of rays.
struct Times {
    std::vector<double> rounds;  ///< ms, of all frames; none: skipped
    ChoiceReport worst;          ///< of the frame with the largest ratio

    double median() const
    {
        std::vector<double> sorted = rounds;
        std::sort(sorted.begin(), sorted.end());
        return sorted.empty() ? NAN : sorted[sorted.size() / 2];
    }
};

class Sweep {
public:
    Sweep(const NamedScene& named, const Settings& settings)
        : name_(named.name), settings_(settings), scene_(read_aff(named.file)), last_(settings.contestants.size())
    {
    }

    void run(int rays, std::ostream& table, std::ostream& csv)
    {
        record(rays);
        std::vector<Times> times(settings_.contestants.size());
        for (std::size_t i = 0; i < times.size(); ++i)
            if (is_wanted(i, rays)) check(settings_.contestants[i]);
        for (int round = 0; round < settings_.rounds; ++round) time_round(rays, static_cast<std::size_t>(round), times);
        print(table, times);
        for (std::size_t i = 0; i < times.size(); ++i) write_line(csv, i, times[i]);
        for (std::size_t i = 0; i < times.size(); ++i)
            if (!times[i].rounds.empty()) last_[i] = times[i].median() / rays;
    }

private:
    using Clock = std::chrono::steady_clock;

    /// Frames and their rays, with the hits that testing in a grid finds.
    void record(int rays)
    {
        const int height = std::max(1, static_cast<int>(std::lround(std::sqrt(0.75 * rays)))),
                  width = std::max(1, static_cast<int>(std::lround(static_cast<double>(rays) / height)));
        const int first = settings_.first >= 0 ? settings_.first : scene_.frames / 3;
        const bool any_transmits = std::any_of(scene_.materials.begin(), scene_.materials.end(),
                                               [](const Material& material) { return material.transmits(); });
        frames_.clear();
        expected_.clear();
        for (int i = 0; i < settings_.frames; ++i)
            frames_.emplace_back(firstray::pose(scene_, scene_.time_of(std::min(first + i, scene_.frames - 1))), width,
                                 height, any_transmits ? RayMask::opaque : RayMask::all);
        const auto grid = entry_of("grid")->make(scene_, options());
        for (FrameRays& frame : frames_) {
            grid->update(frame.pose());
            std::vector<float> hits = answers(*grid, frame, Phase::primary);
            frame.set_hits(hits);
            expected_.push_back(std::move(hits));
            expected_.push_back(answers(*grid, frame, Phase::shadow));
        }
    }

    StrategyOptions options() const
    {
        StrategyOptions options;
        options.executor = &executor_;
        return options;
    }
    std::unique_ptr<Strategy<float>> make(const Contestant& contestant) const
    {
        StrategyOptions chosen = options();
        chosen.own = contestant.own;
        return contestant.entry->make(scene_, chosen);
    }

    static void search(const Strategy<float>& strategy, Phase phase, RayTile<float>& tile)
    {
        phase == Phase::primary ? strategy.closest(tile) : strategy.occluded(tile);
    }

    /// t of nearest hits, or 0 where a shadow ray meets something; infinity for nothing.
    std::vector<float> answers(const Strategy<float>& strategy, const FrameRays& frame, Phase phase)
    {
        std::vector<float> found;
        for (std::size_t batch = 0; batch < frame.batches(phase); ++batch) {
            frame.load(phase, batch, *tile_);
            search(strategy, phase, *tile_);
            for (std::size_t i = 0; i < static_cast<std::size_t>(tile_->count); ++i)
                found.push_back(tile_->primitive[i] == no_primitive ? std::numeric_limits<float>::infinity()
                                : phase == Phase::primary           ? tile_->t_max[i]
                                                                    : 0.0f);
        }
        return found;
    }

    /// throws  Error where an answer is not the grid's, bit for bit
    void check(const Contestant& contestant)
    {
        if (contestant.entry->peer) return;
        const auto strategy = make(contestant);
        for (std::size_t i = 0; i < frames_.size(); ++i) {
            strategy->update(frames_[i].pose());
            for (const Phase phase : {Phase::primary, Phase::shadow})
                if (answers(*strategy, frames_[i], phase) != expected_[2 * i + (phase == Phase::shadow)])
                    throw Error(Fault::rendering, contestant.name + " finds other hits than grid in " + name_);
        }
    }

    bool is_wanted(std::size_t contestant, int rays) const
    {
        return !last_[contestant] || *last_[contestant] * rays < 1000.0 * settings_.limit;
    }

    double milliseconds(Strategy<float>& strategy, const FrameRays& frame)
    {
        Clock::duration spent{};
        const auto timed = [&](const auto& work) {
            const Clock::time_point start = Clock::now();
            work();
            spent += Clock::now() - start;
        };
        timed([&] { strategy.update(frame.pose()); });
        for (const Phase phase : {Phase::primary, Phase::shadow})
            for (std::size_t batch = 0; batch < frame.batches(phase); ++batch) {
                frame.load(phase, batch, *tile_);
                if (tile_->count > 0) timed([&] { search(strategy, phase, *tile_); });
            }
        return std::chrono::duration<double, std::milli>(spent).count();
    }

    /// Contestants begin anew and take turns frame by frame.
    void time_round(int rays, std::size_t round, std::vector<Times>& times)
    {
        const std::size_t count = times.size();
        std::vector<std::unique_ptr<Strategy<float>>> strategies;
        for (std::size_t i = 0; i < count; ++i) {
            strategies.push_back(is_wanted(i, rays) ? make(settings_.contestants[i]) : nullptr);
            if (strategies[i]) times[i].rounds.push_back(0.0);
        }
        for (const FrameRays& frame : frames_)
            for (std::size_t turn = 0; turn < count; ++turn) {
                const std::size_t i = (turn + round) % count;
                if (!strategies[i]) continue;
                times[i].rounds.back() += milliseconds(*strategies[i], frame);
                const ChoiceReport choices = strategies[i]->report().choices;
                if (choices.is_made && choices.ratio() >= times[i].worst.ratio()) times[i].worst = choices;
            }
    }

    std::size_t count(Phase phase) const
    {
        std::size_t sum = 0;
        for (const FrameRays& frame : frames_) sum += frame.count(phase);
        return sum / frames_.size();
    }

    void print(std::ostream& table, const std::vector<Times>& times) const
    {
        double best = INFINITY;  // of those that choose nothing
        for (const Times& t : times)
            if (!t.rounds.empty() && !t.worst.is_made) best = std::min(best, t.median());
        table << std::left << std::setw(9) << name_ << std::right << std::setw(9) << count(Phase::primary)
              << std::setw(10) << count(Phase::shadow) << std::fixed;
        for (const Times& t : times) {
            if (t.rounds.empty())
                table << std::setw(14) << "skipped";
            else
                table << std::setprecision(2) << std::setw(14) << t.median();
            if (t.worst.is_made) table << std::setw(8) << t.median() / best << std::setw(7) << t.worst.ratio();
        }
        table << std::endl;
    }

    void write_line(std::ostream& csv, std::size_t contestant, const Times& times) const
    {
        csv << name_ << ',' << count(Phase::primary) << ',' << count(Phase::shadow) << ',' << frames_.size() << ','
            << settings_.contestants[contestant].name << ',' << times.rounds.size();
        if (times.rounds.empty()) {
            csv << ",,,,\n";
            return;
        }
        const auto [least, most] = std::minmax_element(times.rounds.begin(), times.rounds.end());
        csv << ',' << times.median() << ',' << *least << ',' << *most << ',';
        if (times.worst.is_made) csv << times.worst.ratio();
        csv << std::endl;
    }

    std::string name_;
    const Settings& settings_;
    Scene scene_;
    std::vector<std::optional<double>> last_;  ///< by contestant: ms per ray asked for, at the last number
    Executor executor_{1};
    std::vector<FrameRays> frames_;
    std::vector<std::vector<float>> expected_;  ///< by frame: of primary rays, of shadow rays
    std::unique_ptr<RayTile<float>> tile_ = std::make_unique<RayTile<float>>();
};

void apply(std::string_view flag, std::string_view value, Settings& settings)
{
    if (flag == "--scene")
        settings.scenes.push_back({std::filesystem::path(value).stem().string(), value});
    else if (flag == "--rays") {
        settings.rays.clear();
        for (const std::string_view number : split(value, ',')) settings.rays.push_back(whole_number(flag, number));
    } else if (flag == "--strategies")
        for (const std::string_view name : split(value, ',')) settings.contestants.push_back(contestant_of(name));
    else if (flag == "--frames")
        settings.frames = whole_number(flag, value);
    else if (flag == "--rounds")
        settings.rounds = whole_number(flag, value);
    else if (flag == "--first")
        settings.first = whole_number(flag, value);
    else if (flag == "--limit")
        settings.limit = whole_number(flag, value);
    else if (flag == "--csv")
        settings.csv = value;
    else
        refuse("unknown flag " + std::string(flag));
}

void run_all(int argc, char** argv)
{
    Settings settings;
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument = argv[i];
        const std::size_t equals = argument.find('=');
        apply(argument.substr(0, equals), equals == argument.npos ? "" : argument.substr(equals + 1), settings);
    }
    if (settings.scenes.empty()) settings.scenes = bart_scenes("ray_sweep");
    if (settings.contestants.empty())
        for (const char* name : {"list", "lazy", "adaptive"}) settings.contestants.push_back(contestant_of(name));

    std::ofstream csv;
    if (!settings.csv.empty()) csv.open(settings.csv);
    if (!settings.csv.empty() && !csv) throw Error(Fault::file, "cannot write " + settings.csv);
    csv << "scene,primary,shadow,frames,strategy,rounds,median_ms,least_ms,most_ms,model_ratio\n";
    std::cout << "medians of " << settings.rounds << " rounds, ms for " << settings.frames
              << " frames; behind what chooses: its time by the best other's, its model's worst ratio to hindsight\n"
              << "scene      primary    shadow";
    for (const Contestant& contestant : settings.contestants) std::cout << "  " << contestant.name;
    std::cout << std::endl;
    for (const NamedScene& scene : settings.scenes) {
        Sweep sweep(scene, settings);
        for (const int rays : settings.rays) sweep.run(rays, std::cout, csv);
    }
}

}  // namespace
}  // namespace firstray

int main(int argc, char** argv)
{
    try {
        firstray::run_all(argc, argv);
        return 0;
    } catch (const firstray::Error& error) {
        std::cerr << "ray_sweep: " << error.what() << "\n";
        if (error.fault() == firstray::Fault::usage) std::cerr << firstray::usage;
        return static_cast<int>(error.fault());
    }
}
