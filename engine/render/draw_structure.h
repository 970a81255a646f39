#pragma once
#include <span>

#include "engine/render/camera_rays.h"
#include "engine/render/frame.h"
#include "engine/strategy/outline.h"

namespace firstray::inline v0 {

/// Draws boxes and the edges of their filled cells over a frame, as in figures 5 to 7 of Lext and Akenine-Moller,
/// "Towards Rapid Reconstruction for Animated Ray Tracing", 2001: coloured by level, dim where surfaces hide them, over
/// the picture in subdued colours. Cells, and boxes of subgrids, fade out where they are few pixels wide. Cells that are
/// built when rays enter them are coloured by what has become of them.
/// camera   the one that the frame was rendered with
/// returns  the frame with another picture; the layers stay
Frame draw_structure(const Frame& frame, const CameraRays& camera, std::span<const StructureBox> outline);

/// The colour of a level's lines: seven that the colour-blind can tell apart, over and over.
/// source  M. Okabe, K. Ito, "Color Universal Design", 2008
glm::vec3 level_colour(int level);

/// Orange for what was built in this frame, green for what was kept from earlier ones, grey for what is not built.
glm::vec3 voxel_colour(StructureBox::Voxel state);

}  // namespace firstray::inline v0
