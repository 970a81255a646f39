#pragma once
#include "lazy/rule.h"

namespace firstray::inline v0::lazy {

/// This machine's costs: measured when first asked for, in some 20 ms on one thread, by having the searches and builds
/// that rays use work on a few small scenes. Any number of threads.
const Costs& calibrated_costs();

/// The same, measured anew.
Costs calibrate();

}  // namespace firstray::inline v0::lazy
