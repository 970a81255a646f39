#pragma once
#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measure/contestant.h"
#include "engine/render/render.h"

namespace firstray::compare {

/// What is compared, and how thoroughly.
struct Plan {
    std::vector<Contestant> contestants;
    std::vector<int> frames;  ///< of the scene, ascending
    RenderOptions render;
    StrategyOptions options;     ///< of every contestant; the executor and own choices are set by the contest
    int threads = 0;             ///< 0: all there are
    int repeat = 5;              ///< rounds through all frames that are timed
    std::size_t check_rays = 0;  ///< rays a frame compared with `list`; 0: as many as take it about a third of a second
    std::vector<int> pictured{};   ///< frames to draw
    std::vector<int> frameless{};  ///< X of each share 1/X whose error is wanted
    std::uint64_t seed = 0;        ///< of frameless rendering
    bool trade = false;
};

/// Thrown between two measurements when the user wants no more of them.
class Interrupted : public std::runtime_error {
public:
    Interrupted() : std::runtime_error("interrupted") {}
};

/// How a run is watched. Work is told in renderings of a whole frame, about: then time left can be told too. Callables
/// may be empty.
struct Watch {
    std::function<void(double work)> expect;                          ///< what all steps come to, before the first
    std::function<void(const std::string& what, double work)> begin;  ///< a step begins; the one before it has ended
    std::function<bool()> stop;                                       ///< whether to end early

    /// throws  Interrupted
    void step(const std::string& what, double work) const
    {
        if (stop && stop()) throw Interrupted();
        if (begin) begin(what, work);
    }
};

}  // namespace firstray::compare
