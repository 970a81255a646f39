#pragma once
#include <memory>

#include "engine/strategy/strategy.h"
#include "obb/options.h"

namespace firstray::inline v0::obb {

/// A grid over the static scenery, built once; an oriented box with a grid of its own around what each transform moves,
/// built once; and at every update only the boxes' places, and supergrids over those of each topmost transform. What
/// deforms is rebuilt, alone.
/// source  J. Lext, T. Akenine-Moller, "Towards Rapid Reconstruction for Animated Ray Tracing", 2001, sections 3.1 and
/// 4
template <typename Real>
std::unique_ptr<Strategy<Real>> make_obb(const Scene& scene, const StrategyOptions& options, const Options& boxes = {});

}  // namespace firstray::inline v0::obb
