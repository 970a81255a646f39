#include "bench/micro/summary.h"

#include <algorithm>
#include <cstdio>
#include <ostream>

namespace firstray {
namespace {

constexpr ReportedPart parts[] = {
    {"update", [](const PhaseTimes& times) { return times.update; }, false},
    {"primary", [](const PhaseTimes& times) { return times.primary; }, true},
    {"shadow", [](const PhaseTimes& times) { return times.shadow; }, true},
    {"trace", [](const PhaseTimes& times) { return times.primary + times.shadow; }, true},
    {"frame", [](const PhaseTimes& times) { return times.update + times.primary + times.shadow; }, true},
    {"scattered", [](const PhaseTimes& times) { return times.scattered; }, true},
};

template <typename... Values>
std::string format(const char* pattern, Values... values)
{
    char text[160];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

void write_line(std::ostream& out, bool scattered, const Measured& base, const Measured& measured)
{
    out << format("  %-36s", measured.name.c_str());
    for (const ReportedPart& part : reported_parts(scattered)) {
        const Spread ratio = ratio_to(base, measured, part);
        out << format(" %9.1f ms x%6.3f [%6.3f %6.3f]", 1e3 * typical_seconds(measured, part), ratio.median,
                      ratio.least, ratio.most);
    }
    out << format(" %9.1f\n", measured.agreement.per_million());
}

}  // namespace

std::span<const ReportedPart> reported_parts(bool scattered)
{
    return {parts, std::size(parts) - (scattered ? 0 : 1)};
}

double round_seconds(const Measured& measured, std::size_t round, const ReportedPart& part)
{
    double seconds = 0.0;
    for (const PhaseTimes& times : measured.rounds[round]) seconds += part.seconds(times);
    return seconds;
}

double typical_seconds(const Measured& measured, const ReportedPart& part)
{
    double seconds = 0.0;
    for (std::size_t frame = 0; frame < measured.rounds.front().size(); ++frame) {
        std::vector<double> samples;
        for (const auto& round : measured.rounds) samples.push_back(part.seconds(round[frame]));
        seconds += median(samples);
    }
    return seconds;
}

Spread ratio_to(const Measured& base, const Measured& measured, const ReportedPart& part)
{
    std::vector<double> ratios;
    for (std::size_t round = 0; round < measured.rounds.size(); ++round) {
        const double cost = round_seconds(measured, round, part) / round_seconds(base, round, part);
        ratios.push_back(part.faster_is_above_one ? 1.0 / cost : cost);
    }
    return spread_of(ratios);
}

std::uint64_t rays_of(const Measurement& measurement, const ReportedPart& part)
{
    std::uint64_t rays = 0;
    if (part.name == "primary" || part.name == "trace") rays += measurement.primary;
    if (part.name == "shadow" || part.name == "trace") rays += measurement.shadow;
    if (part.name == "scattered") rays += measurement.scattered;
    return rays;
}

const Measured* timed(const Measurement& measurement, std::string_view name)
{
    for (const Measured& measured : measurement.strategies)
        if (measured.name == name && measured.fault.empty()) return &measured;
    return nullptr;
}

const Measured* best_peer(const Measurement& measurement)
{
    const ReportedPart& frame = *std::find_if(std::begin(parts), std::end(parts),
                                              [](const ReportedPart& part) { return part.name == "frame"; });
    const Measured* best = nullptr;
    for (const Measured& measured : measurement.strategies)
        if (measured.is_peer && measured.fault.empty() &&
            (!best || typical_seconds(measured, frame) < typical_seconds(*best, frame)))
            best = &measured;
    return best;
}

void write_table(std::ostream& out, std::string_view scene, const Measurement& measurement, const Measured* base)
{
    out << "\n" << scene << ": milliseconds (medians over the rounds, summed over the frames)";
    if (!base) {
        out << "; no ratios, since what they are to was not timed\n";
        return;
    }
    out << format(", %zu rounds, %.1f M primary and %.1f M shadow rays\n", base->rounds.size(),
                  1e-6 * static_cast<double>(measurement.primary), 1e-6 * static_cast<double>(measurement.shadow));
    out << "  x update: this / " << base->name << "; x otherwise: " << base->name << " / this, so above 1 is faster; "
        << "median [least most] of the rounds; differ: rays per million unlike the reference\n";
    out << format("  %-36s", "strategy");
    const bool scattered = measurement.scattered > 0;
    for (const ReportedPart& part : reported_parts(scattered)) out << format(" %35s", std::string(part.name).c_str());
    out << format(" %9s\n", "differ");
    for (const Measured& measured : measurement.strategies)
        if (measured.fault.empty())
            write_line(out, scattered, *base, measured);
        else
            out << "  " << measured.name << ": not timed: " << measured.fault << "\n";
}

}  // namespace firstray
