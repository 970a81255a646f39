#pragma once
#include <vector>

namespace firstray {

/// What repeated measurements say: noise shows in how far `least` and `most` are apart.
struct Spread {
    double median = 0.0, least = 0.0, most = 0.0;
};

/// The middle value, or the mean of the two in the middle.
/// values  at least one
double median(std::vector<double> values);

/// values  at least one
Spread spread_of(const std::vector<double>& values);

/// The value that a share of all lies at or below: 0 gives the least, 1 the largest.
/// values  any order; 0 where there are none
double quantile(std::vector<double> values, double share);

}  // namespace firstray
