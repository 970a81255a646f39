#pragma once
#include <glm/glm.hpp>

#include <memory>
#include <vector>

#include "engine/core/aabb.h"
#include "engine/core/made_once.h"
#include "engine/core/transform.h"
#include "engine/grid/build.h"
#include "engine/grid/entries.h"
#include "engine/grid/grid.h"
#include "engine/primitive/quadric.h"
#include "engine/scene/scene.h"
#include "obb/hierarchy.h"

namespace firstray::inline v0::obb {

/// A system whose origin is an oriented box's middle, and whose axes are its edges. Lengths are the root system's where
/// the box was made for; a transform whose scale changes just stretches it.
struct BoxSystem {
    Transform local_from_node, node_from_local;  ///< node: the group's
    DAabb bounds;                                ///< local, around all primitives; empty where there is nothing to hit
};

/// What is in a box and is made when the first ray enters it.
struct Promise {
    MadeOnce<GridStructure> made;
    GridEntries entries;  ///< what it is made of; the one who makes it empties it
    GridOptions shape;
};

/// An oriented box that keeps its grid.
struct Box : BoxSystem {
    GridStructure inside;              ///< local; empty where it is promised
    std::unique_ptr<Promise> promise;  ///< null where it is there from the beginning
    float blur = 0.0f;                 ///< see GridEntries

    /// What is inside, or null where no ray has asked for it.
    const GridStructure* grid() const { return promise ? promise->made.get() : &inside; }
    /// The same, made now if it was not; null while another thread makes it, or where there is no memory for it. Any
    /// number of threads.
    const GridStructure* enter() const;
    std::uint64_t bytes() const;
    std::vector<RootQuadric> quadrics;  ///< placed in the box's system, by ascending id; only where hits are local
};

/// The largest factor by which a linear map makes the largest component of a vector larger.
double size_of(const glm::dmat3& linear);

/// By how much a vertex's place in a box may differ from the place where it is tested in the root system, in the box's
/// lengths, per coordinate: the roundings of both, to float. In double it is less, but the same is reckoned with: it
/// also covers that rays from far off, 1e6 times the box's place, are carried into its system in double.
/// local_from_root  linear part
/// largest          largest coordinate of the box in the root system
double blur_of(const glm::dmat3& local_from_root, double largest);

/// What boxes are made of and for.
struct BoxMaker {
    const Scene& scene;
    GridOptions grid;
    Inside inside = Inside::automatic;
    bool keep_quadrics = false;

    /// Makes the smallest box of a group that does not deform.
    /// root_from_node  where its node stands now: its scale, shear and orientation shape the box, its offset does not
    /// largest         largest coordinate in the root system that the box is to be right for
    Box make(const BoxPlan& plan, const Transform& root_from_node, double largest, std::uint64_t& peak_bytes) const;

    /// Makes a box whose system is known.
    /// blur  see GridEntries
    Box make_in(const BoxPlan& plan, const Transform& local_from_node, float blur, std::uint64_t& peak_bytes) const;

    /// Makes a box that is not kept, for what deforms or is out of range: axis-aligned, in the root system itself, from
    /// its carried primitives, which must stay as they are as long as the box is used.
    template <typename Real>
    Box make_in_root(const BoxPlan& plan, const RootGeometry<Real>& geometry, const Transform& root_from_node,
                     const Executor* executor, std::uint64_t& peak_bytes) const;

    /// The largest coordinate of a group's vertices and shapes, in its node's system; infinite where a shape reaches
    /// too far to tell. What is not finite is left out: it is nowhere.
    double reach_of(const BoxPlan& plan) const;

private:
    GridOptions shape_of(std::size_t primitives) const;
    void fill(Box& box, GridEntries entries, PackOrder order, const Executor* executor,
              std::uint64_t& peak_bytes) const;
};

}  // namespace firstray::inline v0::obb
