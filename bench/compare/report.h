#pragma once
#include <string>
#include <vector>

#include "bench/compare/pictures.h"
#include "bench/compare/results.h"

namespace firstray::compare {

/// The whole report as one HTML page that needs nothing else: no network, no script. Every number in it is in the
/// results document.
std::string report_html(const Json& results, const std::vector<FramePictures>& pictures);

}  // namespace firstray::compare
