#pragma once
#include <glm/glm.hpp>

#include <vector>

#include "engine/render/camera_rays.h"
#include "engine/render/frame.h"

namespace firstray::inline v0 {

/// How a line is drawn.
struct Pen {
    glm::vec3 colour{1.0f};
    float strength = 1.0f;  ///< share of the picture that the line covers where it is visible, in [0, 1]
    double width = 1.0;     ///< pixels
    double spacing = 0.0;   ///< from the line to others like it, root units: faded where that is few pixels; 0: never
};

/// Thin lines in space over a frame, anti-aliased; dim where the frame's surfaces hide them. Of lines that meet in a
/// pixel the strongest counts alone: many faint ones do not add up to a strong one.
class LineLayer {
public:
    /// Both must outlive the layer.
    LineLayer(const Frame& frame, const CameraRays& camera);

    /// Draws from a to b, root system. What is nearer than the near plane or beyond the picture is cut off, and a line
    /// that is not finite is not drawn.
    void draw(const glm::dvec3& a, const glm::dvec3& b, const Pen& pen);

    /// The lines over a picture of the frame's size.
    void cover(std::vector<glm::vec3>& colour) const;

private:
    struct Ink {
        glm::vec3 colour{0.0f};
        float strength = 0.0f;
    };
    struct Segment;
    struct Stroke;
    void draw(const Stroke& stroke, const Pen& pen);
    bool is_hidden(const Stroke& stroke) const;
    std::size_t pixel_of(const Stroke& stroke, int k) const;

    const Frame& frame_;
    const CameraRays& camera_;
    double pixel_;           ///< its size at depth 1
    std::vector<Ink> inks_;  ///< by pixel
};

/// Lines are gone where they stand closer than the first and full where farther apart than the second, pixels.
inline constexpr double faded_spacing = 4.0, full_spacing = 16.0;

/// Share of its strength that a line keeps where it is hidden.
inline constexpr float hidden_share = 0.22f;

}  // namespace firstray::inline v0
