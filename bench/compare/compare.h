#pragma once
#include <filesystem>
#include <span>

#include "bench/compare/pictures.h"
#include "bench/compare/results.h"

namespace firstray::compare {

/// What a run gives.
struct Report {
    Json results;
    std::vector<FramePictures> pictures;
};

/// Runs the whole comparison that the plan asks for. What a contestant throws becomes its row's reason; an interruption
/// ends the run with what is finished.
/// throws   what the reference throws
Report compare(const Scene& scene, std::span<const Texture> textures, const Plan& plan, RunFacts facts,
               const Watch& watch);

/// Writes index.html, results.json and results.csv into a folder that is made where it is missing.
/// throws  FileError
void write_report(const std::filesystem::path& folder, const Report& report);

}  // namespace firstray::compare
