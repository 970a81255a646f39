#pragma once
#include "scenes/generator/aff_writer.h"
#include "scenes/generator/generate.h"

namespace firstray::scenes {

/// Ground around the origin: gentle waves where the town is, hills around it. Metres.
class Ground {
public:
    /// town_radius  where the hills begin
    Ground(double town_radius, std::uint64_t seed);

    double extent() const;  ///< half the side of the square that is there
    bool in_town(double x, double z) const;
    glm::dvec3 on(double x, double z) const;

private:
    double town_radius_;
    std::uint64_t seed_;
};

/// Ground of about `triangles` triangles, at least 128, cut into patches; its textures too.
void write_ground(const Request& request, const Ground& ground, std::uint64_t triangles, AffWriter& main);

}  // namespace firstray::scenes
