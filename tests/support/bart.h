#pragma once
#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>

namespace firstray::test {

/// A file of the BART scenes, e.g. "robots/Robot.aff": in the folder that FIRSTRAY_BART_DIR names, or beside the
/// project. returns  nothing when it is not there; the message then shows which test was skipped
inline std::optional<std::filesystem::path> bart_file(const std::string& relative)
{
    const char* folder = std::getenv("FIRSTRAY_BART_DIR");
    const std::filesystem::path path = std::filesystem::path(folder && *folder ? folder : "../shared/bart") / relative;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(path, ignored)) return path;
    MESSAGE("skipped: BART scenes needed, no file " << path.string() << " (set FIRSTRAY_BART_DIR)");
    return std::nullopt;
}

}  // namespace firstray::test
