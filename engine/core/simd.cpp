#include "engine/core/simd.h"

#include <stdexcept>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "engine/core/simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace firstray::inline v0 {
namespace HWY_NAMESPACE {

std::int64_t this_target()
{
    return HWY_TARGET;
}

}  // namespace HWY_NAMESPACE
}  // namespace firstray::inline v0
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace firstray::inline v0 {
namespace {

HWY_EXPORT(this_target);

/// Makes the next dispatch choose anew.
void choose_again()
{
    hwy::GetChosenTarget().DeInit();
}

std::vector<std::int64_t> targets()
{
    std::vector<std::int64_t> found;
    for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1)
        found.push_back(left & -left);
    return found;  // better sets have lower bits
}

}  // namespace

std::vector<std::string> instruction_sets()
{
    const std::string in_use = instruction_set();
    use_instruction_set("");
    std::vector<std::string> names;
    for (const std::int64_t target : targets()) names.emplace_back(hwy::TargetName(target));
    use_instruction_set(in_use);
    return names;
}

std::string instruction_set()
{
    return hwy::TargetName(HWY_DYNAMIC_DISPATCH(this_target)());
}

void use_instruction_set(std::string_view name)
{
    hwy::SetSupportedTargetsForTest(0);
    choose_again();
    if (name.empty()) return;
    for (const std::int64_t target : targets())
        if (name == hwy::TargetName(target)) {
            hwy::SetSupportedTargetsForTest(target);
            choose_again();
            return;
        }
    throw std::invalid_argument("no instruction set " + std::string(name) + " on this machine");
}

}  // namespace firstray::inline v0
#endif  // HWY_ONCE
