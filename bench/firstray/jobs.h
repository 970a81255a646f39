#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "bench/firstray/command.h"
#include "engine/scene/scene.h"
#include "engine/strategy/strategy.h"

namespace firstray::command {

/// What the options of a command set, as typed; the command itself gives it meaning.
struct SceneChoice {
    std::string file;
    bool allow_outside = false;  ///< includes and textures may lie outside the scene's folder
    std::string limits;          ///< NAME=N,... that replace defaults
};

struct SearchChoice {
    std::string strategy = "grid";
    std::string precision = "robust";
    int threads = 0;
    float grid_density = 0.0f;
    int max_list = 0;
    int grid_depth = StrategyOptions{}.grid_depth;
    std::uint64_t structure_budget = 0;
    std::map<std::string, std::string, std::less<>> own;  ///< StrategyOptions::own, by flag
};

struct RenderJob {
    SceneChoice scene;
    SearchChoice search;
    std::string frames = "0";
    std::string size;  ///< empty: the scene's
    int depth = 4;
    int samples = 1;
    std::string frameless = "1";
    std::uint64_t seed = 0;
    std::string aovs;
    std::string output;  ///< empty: the scene's name in the current folder
    std::string stats;   ///< empty: none
    std::string progress = "auto";
    bool resume = false;  ///< keep the frames that are there
    bool table = false;
    bool structure = false;  ///< draw it over the pictures
};

struct CompareJob {
    SceneChoice scene;
    std::string other;       ///< the second of two results to be compared; the first is then scene.file
    SearchChoice search;     ///< of every strategy
    std::string strategies;  ///< empty: all
    std::string frames;      ///< empty: some, spread over the animation
    std::string size;        ///< empty: the scene's
    int depth = 4;
    int samples = 1;
    int repeat = 5;
    int check_rays = 0;
    std::string pictures;   ///< frames to draw; empty: the one of most rays
    std::string frameless;  ///< shares to try; empty: none
    std::uint64_t seed = 0;
    std::string report;  ///< folder; empty: out/NAME-report
    bool trade = false;  ///< also try what buys speed with accuracy
    bool json = false;
    std::string progress = "auto";
    std::string command_line;
};

struct InfoJob {
    SceneChoice scene;
    bool json = false;
    bool structure = false;  ///< also tell of the structure, which the others choose
    SearchChoice search;
    int frame = 0;
    std::string costs;  ///< not empty: tell what adaptive counts with; the flag alone is "true"

    bool replaces_costs() const { return !costs.empty() && costs != "true"; }
};

struct TraceJob {
    SceneChoice scene;
    SearchChoice search;
    int frame = 0;
    std::string rays;
    std::string output;  ///< empty: standard output
};

/// Each throws Error for what is the user's to mend, and whatever the engine throws.
void render_scene(const RenderJob& job, Streams streams);
void compare_strategies(const CompareJob& job, Streams streams);
void print_info(const InfoJob& job, Streams streams);
void trace_rays(const TraceJob& job, Streams streams);

}  // namespace firstray::command
