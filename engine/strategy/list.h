#pragma once
#include <memory>

#include "engine/strategy/strategy.h"

namespace firstray::inline v0 {

/// Tests every ray against every primitive, by the test itself and nothing that chooses: the truth the others are held
/// to.
template <typename Real>
std::unique_ptr<Strategy<Real>> make_list(const Scene& scene, const StrategyOptions& options);

}  // namespace firstray::inline v0
