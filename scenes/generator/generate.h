#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace firstray::scenes {

/// What to write. The same request gives the same bytes.
struct Request {
    std::filesystem::path file;  ///< the scene; other files stand beside it, their names begin with its stem
    std::uint64_t seed = 1;
    double amount = 0.0;  ///< of what the scene has a choice of: triangles, robots, a ratio

    /// Name of another file of the scene, as the scene mentions it: "crowd_town.aff".
    std::string name(std::string_view rest) const { return file.stem().string() + "_" + std::string(rest); }
    std::filesystem::path beside(std::string_view rest) const { return file.parent_path() / name(rest); }
};

/// A scene that can be made.
struct SceneEntry {
    std::string_view name;
    std::string_view summary;  ///< one line for --help
    std::string_view option;   ///< that sets the amount, e.g. "--triangles"; empty: there is none
    std::string_view meaning;  ///< of the option
    double usual = 0.0, low = 0.0, high = 0.0;
    bool whole = true;                       ///< the amount is a whole number
    std::uint64_t (*write)(const Request&);  ///< returns the triangles written; throws FileError
};

/// All of them; the command and the tests loop over this.
std::span<const SceneEntry> scene_entries();

std::uint64_t write_robot(const Request& request);
std::uint64_t write_robots(const Request& request);
std::uint64_t write_art(const Request& request);
std::uint64_t write_stadium(const Request& request);
std::uint64_t write_crowd(const Request& request);
std::uint64_t write_explode(const Request& request);

}  // namespace firstray::scenes
