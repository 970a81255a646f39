#pragma once
#include <memory>

#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// One recursive grid over all primitives in the root system, built anew at every update: the baseline of Lext and
/// Akenine-Moller, "Towards Rapid Reconstruction for Animated Ray Tracing", 2001.
template <typename Real>
std::unique_ptr<Strategy<Real>> make_grid(const Scene& scene, const StrategyOptions& options);

}  // namespace firstray::inline v0
