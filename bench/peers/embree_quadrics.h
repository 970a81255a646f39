#pragma once
#include <vector>

#include "bench/peers/embree_device.h"
#include "engine/primitive/quadric.h"

namespace firstray::peers {

/// Makes `geometry` a user geometry over quadrics, intersected in double by the engine's own test.
/// quadrics  placed in the system of the Embree scene, which need not be the root's; must stay where they are while the
///           geometry is in use
void set_quadrics(RTCGeometry geometry, const std::vector<RootQuadric>& quadrics);

}  // namespace firstray::peers
