#pragma once
#include <vector>

#include "obb/options.h"

namespace firstray::test {

/// Every way to build a hierarchy whose hits are the root system's.
inline std::vector<obb::Options> obb_variants()
{
    std::vector<obb::Options> variants;
    for (const obb::Groups groups : {obb::Groups::dynamic, obb::Groups::all})
        for (const obb::Top top : {obb::Top::grid, obb::Top::list})
            for (const obb::Inside inside : {obb::Inside::automatic, obb::Inside::grid, obb::Inside::list})
                variants.push_back({groups, top, obb::Hits::root, inside});
    variants.push_back({.inside = obb::Inside::lazy});
    return variants;
}

}  // namespace firstray::test
