#pragma once
#include <filesystem>
#include <span>

#include "bench/compare/results.h"

namespace firstray::compare {

/// Runs the whole comparison that the plan asks for. What a contestant throws becomes its row's reason; an interruption
/// ends the run with what is finished.
/// returns  the document that results.h describes
/// throws   what the reference throws
Json compare(const Scene& scene, std::span<const Texture> textures, const Plan& plan, RunFacts facts,
             const Watch& watch);

/// Writes results.json and results.csv into a folder that is made where it is missing.
/// throws  FileError
void write_report(const std::filesystem::path& folder, const Json& results);

}  // namespace firstray::compare
