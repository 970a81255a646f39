#pragma once
#include <iosfwd>
#include <span>
#include <string_view>
#include <vector>

#include "bench/measure/spread.h"
#include "bench/micro/measurement.h"

namespace firstray {

/// A part of a frame that is reported.
struct ReportedPart {
    std::string_view name;
    double (*seconds)(const PhaseTimes& times);
    bool faster_is_above_one;  ///< ratio is base / strategy (relative speed), else strategy / base (relative cost)
};

/// update, primary, shadow, trace (primary and shadow), frame (all of these), and scattered, if that is wanted.
std::span<const ReportedPart> reported_parts(bool scattered);

/// Seconds that a part took in all frames of one round.
double round_seconds(const Measured& measured, std::size_t round, const ReportedPart& part);
/// Sum over frames of the median over rounds, seconds.
double typical_seconds(const Measured& measured, const ReportedPart& part);
/// How a strategy compares with the base, round by round: a round's measurements were taken side by side. Both have at
/// least one round.
Spread ratio_to(const Measured& base, const Measured& measured, const ReportedPart& part);
/// Rays that a part traces in all frames; none for update and frame.
std::uint64_t rays_of(const Measurement& measurement, const ReportedPart& part);

/// The peer whose frames took least, by typical_seconds(), among those that were timed; null where none was.
const Measured* best_peer(const Measurement& measurement);

/// The entry of that name if it was timed, else null.
const Measured* timed(const Measurement& measurement, std::string_view name);

/// Writes a table of ratios: a line per strategy, with spread, number of rounds and share of differing rays.
/// base  whom to compare with; null where it was not timed
void write_table(std::ostream& out, std::string_view scene, const Measurement& measurement, const Measured* base);

}  // namespace firstray
