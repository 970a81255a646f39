#pragma once
#include <memory>

#include "engine/strategy/strategy.h"
#include "lazy/options.h"

namespace firstray::inline v0::lazy {

/// A recursive grid of which an update makes the top level only, and of what moves not even that: the first ray that
/// enters a group's box has the group carried, the first that enters a voxel has it built. What has not moved stays.
/// source  J. Lext, T. Akenine-Moller, "Towards Rapid Reconstruction for Animated Ray Tracing", 2001, section 3.2
template <typename Real>
std::unique_ptr<Strategy<Real>> make_lazy(const Scene& scene, const StrategyOptions& options, const Options& own = {});

}  // namespace firstray::inline v0::lazy
