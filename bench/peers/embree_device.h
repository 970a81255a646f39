#pragma once
#include <embree3/rtcore.h>

#include <atomic>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "engine/strategy/strategy.h"

namespace firstray::peers {

struct ReleaseScene {
    void operator()(RTCScene scene) const { rtcReleaseScene(scene); }
};
struct ReleaseGeometry {
    void operator()(RTCGeometry geometry) const { rtcReleaseGeometry(geometry); }
};
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, ReleaseScene>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, ReleaseGeometry>;

/// How a scene is built.
struct BuildChoice {
    /// With RTC_BUILD_QUALITY_REFIT a geometry's first tree is of medium quality, and follows its primitives from then
    /// on.
    RTCBuildQuality quality = RTC_BUILD_QUALITY_MEDIUM;
    RTCSceneFlags flags = RTC_SCENE_FLAG_NONE;
};

/// The same with RTC_SCENE_FLAG_ROBUST, unless the precision is fast.
BuildChoice with_precision(BuildChoice choice, Precision precision);

/// An Embree device that counts the bytes it allocates. Outlives every scene and geometry made from it. Held to what
/// our own kernels are held to, see engine/core/simd.h: the instruction set in use when it is made.
class Device {
public:
    /// executor  whose number of threads builds; null: one thread
    /// throws    Error when there is no device or it lacks ray masks
    explicit Device(const Executor* executor);
    ~Device() { rtcReleaseDevice(device_); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    SceneHandle new_scene(const BuildChoice& choice) const;
    GeometryHandle new_geometry(RTCGeometryType type, RTCBuildQuality quality) const;
    /// Builds what changed.
    /// throws Error when Embree reports a fault since the last call
    void commit(RTCScene scene) const;

    /// Rays that are traced at once without being cut into smaller packets: 16, 8 or 4; 1 where there are no packets.
    int packet_width() const;
    std::string version() const;

    std::uint64_t bytes() const { return static_cast<std::uint64_t>(bytes_.load()); }
    std::uint64_t peak_bytes() const { return static_cast<std::uint64_t>(peak_.load()); }

private:
    static bool count_bytes(void* self, ssize_t bytes, bool post);

    std::atomic<std::int64_t> bytes_{0}, peak_{0};  // Embree allocates from all its threads
    RTCDevice device_ = nullptr;
};

/// Lanes flush subnormal numbers to zero while this lives, as Embree recommends; the caller's mode comes back after it.
class FlushSubnormals {
public:
    FlushSubnormals();
    ~FlushSubnormals();
    FlushSubnormals(const FlushSubnormals&) = delete;
    FlushSubnormals& operator=(const FlushSubnormals&) = delete;

private:
    unsigned saved_;
};

}  // namespace firstray::peers
