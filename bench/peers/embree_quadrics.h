#pragma once
#include <vector>

#include "bench/peers/embree_device.h"
#include "engine/scene/scene.h"

namespace firstray::peers {

/// A quadric in the system of the Embree scene that holds it ("body").
struct PlacedQuadric {
    Quadric::Kind kind = Quadric::Kind::sphere;
    bool inside_only = false;
    double r0 = 1.0, r1 = 1.0;
    Transform body_from_quadric, quadric_from_body;
};

PlacedQuadric place(const Quadric& quadric, const Transform& body_from_group);

/// Makes `geometry` a user geometry over quadrics, intersected in double in their canonical systems.
/// quadrics  must stay where they are while the geometry is in use
void set_quadrics(RTCGeometry geometry, const std::vector<PlacedQuadric>& quadrics);

}  // namespace firstray::peers
