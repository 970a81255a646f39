#pragma once
#include "lazy/rule.h"

namespace firstray::test {

/// Round numbers: of ten triangles a list takes 10 ns a ray, a grid 2 and 80 to be built, so that the 11th ray builds.
inline constexpr lazy::Costs easy = {.test = 1,
                                     .test_alone = 100,
                                     .pack = 1,
                                     .entry = 1,
                                     .packing = 3,
                                     .carrying = 1,
                                     .listing = 2,
                                     .building = 2,
                                     .making = 20};

}  // namespace firstray::test
