#pragma once
#include <cstdint>
#include <nlohmann/json.hpp>

#include "engine/render/render.h"
#include "engine/strategy/strategy.h"

namespace firstray {

using Json = nlohmann::ordered_json;

/// What rendering one frame took and gave. Files are neither read nor written while these clocks run.
struct FrameStats {
    int frame = 0;
    double time = 0.0;  ///< seconds of the animation
    double pose_ms = 0.0;
    double update_ms = 0.0;  ///< posing included
    double trace_ms = 0.0;
    RayCounts rays;
    StructureReport structure;
    std::uint64_t image_hash = 0;

    double total_ms() const { return update_ms + trace_ms; }
    double rays_per_microsecond() const { return static_cast<double>(rays.total()) / (1000.0 * trace_ms); }
};

Json to_json(const FrameStats& stats);
Json to_json(const RayCounts& rays);
Json to_json(const StructureReport& report);

/// The processor, the threads and instruction set it offers, the compiler, our version, the libraries' and
/// the peers'.
Json describe_machine();

}  // namespace firstray
