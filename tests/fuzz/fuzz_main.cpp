// What libFuzzer calls; FIRSTRAY_FUZZ_TARGET is one of targets.h. An exception that leaves it is a finding.
#include <cstddef>

#include "tests/fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    firstray::fuzz::FIRSTRAY_FUZZ_TARGET({data, size});
    return 0;
}
