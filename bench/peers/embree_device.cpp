#include "bench/peers/embree_device.h"

#include <string>
#include <utility>

#include "bench/peers/embree.h"
#include "engine/core/errors.h"
#include "engine/core/simd.h"

#ifdef __SSE__
#include <xmmintrin.h>
#endif

namespace firstray::peers {
namespace {

/// throws  Error when the device has reported a fault (of any thread's call) since it was last asked
void check(RTCDevice device, const char* doing)
{
    const RTCError code = rtcGetDeviceError(device);
    if (code == RTC_ERROR_NONE) return;
    throw Error(Fault::rendering, std::string("Embree: ") + doing + " failed with RTCError " + std::to_string(code));
}

/// Embree's word for the instruction set that our kernels use. It has none between ours and the next lower one of its
/// own.
std::string isa_in_use()
{
    const std::string ours = instruction_set();
    if (ours.starts_with("AVX3")) return "avx512";
    if (ours == "AVX2") return "avx2";
    return ours == "SSE4" ? "sse4.2" : "sse2";
}

}  // namespace

BuildChoice with_precision(BuildChoice choice, Precision precision)
{
    if (precision != Precision::fast) choice.flags = RTCSceneFlags(choice.flags | RTC_SCENE_FLAG_ROBUST);
    return choice;
}

Device::Device(const Executor* executor)
{
    const int threads = executor ? executor->threads() : 1;
    device_ = rtcNewDevice(("threads=" + std::to_string(threads) + ",isa=" + isa_in_use()).c_str());
    if (!device_) check(nullptr, "making a device");
    if (!rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_RAY_MASK_SUPPORTED)) {
        rtcReleaseDevice(device_);
        throw Error(Fault::rendering, "Embree: built without ray masks, expected EMBREE_RAY_MASK=ON");
    }
    rtcSetDeviceMemoryMonitorFunction(device_, &Device::count_bytes, this);
}

bool Device::count_bytes(void* self, ssize_t bytes, bool /*post*/)
{
    Device& device = *static_cast<Device*>(self);
    const std::int64_t now = device.bytes_.fetch_add(bytes) + bytes;
    std::int64_t peak = device.peak_.load();
    while (now > peak && !device.peak_.compare_exchange_weak(peak, now)) {
    }
    return true;  // go on
}

SceneHandle Device::new_scene(const BuildChoice& choice) const
{
    SceneHandle scene(rtcNewScene(device_));
    check(device_, "making a scene");
    // A scene of medium quality is always built anew; in one of low quality each geometry has a tree of its own
    // quality.
    const bool refits = choice.quality == RTC_BUILD_QUALITY_REFIT;
    rtcSetSceneBuildQuality(scene.get(), refits ? RTC_BUILD_QUALITY_LOW : choice.quality);
    rtcSetSceneFlags(scene.get(), choice.flags);
    return scene;
}

GeometryHandle Device::new_geometry(RTCGeometryType type, RTCBuildQuality quality) const
{
    GeometryHandle geometry(rtcNewGeometry(device_, type));
    check(device_, "making a geometry");
    rtcSetGeometryBuildQuality(geometry.get(), quality);
    return geometry;
}

void Device::commit(RTCScene scene) const
{
    rtcCommitScene(scene);
    check(device_, "building a scene");
}

int Device::packet_width() const
{
    constexpr std::pair<RTCDeviceProperty, int> widths[] = {{RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED, 16},
                                                            {RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED, 8},
                                                            {RTC_DEVICE_PROPERTY_NATIVE_RAY4_SUPPORTED, 4}};
    for (const auto& [property, width] : widths)
        if (rtcGetDeviceProperty(device_, property)) return width;
    return 1;
}

int embree_packet_width()
{
    return Device(nullptr).packet_width();
}

std::string Device::version() const
{
    const auto version = rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_VERSION);  // 31305 is 3.13.5
    return std::to_string(version / 10000) + "." + std::to_string(version / 100 % 100) + "." +
           std::to_string(version % 100);
}

std::string embree_version()
{
    return Device(nullptr).version();
}

#ifdef __SSE__
FlushSubnormals::FlushSubnormals() : saved_(_mm_getcsr())
{
    constexpr unsigned flush_results = 0x8000, operands_are_zero = 0x0040;  // FTZ and DAZ of MXCSR
    _mm_setcsr(saved_ | flush_results | operands_are_zero);
}
FlushSubnormals::~FlushSubnormals()
{
    _mm_setcsr(saved_);
}
#else
FlushSubnormals::FlushSubnormals() : saved_(0) {}
FlushSubnormals::~FlushSubnormals() = default;
#endif

}  // namespace firstray::peers
