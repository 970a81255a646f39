#pragma once

namespace firstray::inline v0 {

/// How the test of a ray and a triangle is computed; t, u and v have the precision of a strategy's `Real`.
enum class Precision {
    fast,    ///< float; rays can leak through edges and vertices
    robust,  ///< float, and where float cannot tell, double, and where double cannot tell, exact: watertight
    double_  ///< double vertices and rays, exact signs
};

}  // namespace firstray::inline v0
