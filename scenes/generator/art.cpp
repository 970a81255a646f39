#include <algorithm>
#include <array>
#include <cmath>

#include "scenes/generator/gallery.h"
#include "scenes/generator/generate.h"
#include "scenes/generator/looks.h"
#include "scenes/generator/motion.h"
#include "scenes/generator/random.h"
#include "scenes/generator/split_writer.h"

namespace firstray::scenes {
namespace {

constexpr int shapes = 7;
constexpr double seconds_per_shape = 1.0, radius = 0.62;
const glm::dvec3 centre(0.0, plinth_height + 0.78, 0.0);

/// What the thing is at a second: a sphere whose radius waves, stretched and twisted.
struct Shape {
    double lobes, lobe_depth;  ///< around the axis
    double rings, ring_depth;  ///< from pole to pole
    double twist;              ///< radians from bottom to top
    double height, waist;      ///< scale along the axis; how far the middle is drawn in
};

constexpr Shape all_shapes[shapes] = {{6, 0.00, 4, 0.00, 0.0, 1.10, 0.00}, {6, 0.16, 4, 0.00, 1.2, 1.00, 0.00},
                                      {6, 0.28, 4, 0.06, 2.6, 1.15, 0.25}, {6, 0.10, 4, 0.16, 1.0, 1.05, -0.10},
                                      {6, 0.22, 4, 0.20, 0.0, 0.95, 0.10}, {6, 0.34, 4, 0.02, -2.2, 1.20, 0.45},
                                      {6, 0.00, 4, 0.00, 0.0, 1.10, 0.00}};

/// u around, v from the lower pole to the upper.
glm::dvec3 point(const Shape& s, double phase, double u, double v)
{
    const double polar = M_PI * v, around = 2.0 * M_PI * u, sine = std::sin(polar);
    const double lobes = s.lobe_depth * sine * std::cos(s.lobes * around + phase);
    const double rings = s.ring_depth * sine * sine * std::cos(2.0 * s.rings * polar);
    const double r = radius * (1.0 + lobes + rings - s.waist * sine * sine * std::exp(-8.0 * (v - 0.5) * (v - 0.5)));
    const double angle = around + s.twist * (v - 0.5);
    return centre +
           glm::dvec3(r * sine * std::cos(angle), -radius * s.height * std::cos(polar), -r * sine * std::sin(angle));
}

glm::dvec3 normal(const Shape& s, double phase, double u, double v)
{
    if (v <= 0.0 || v >= 1.0) return {0.0, v <= 0.0 ? -1.0 : 1.0, 0.0};
    const double e = 1e-5;
    const glm::dvec3 du = point(s, phase, u + e, v) - point(s, phase, u - e, v),
                     dv = point(s, phase, u, v + e) - point(s, phase, u, v - e);
    return glm::normalize(glm::cross(du, dv));
}

double cut(double value, double step)
{
    return std::round(value / step) * step;
}

/// Writes the thing triangle by triangle.
class ThingWriter {
public:
    ThingWriter(const Request& request, AffWriter& main, int columns, int rows)
        : files_(request, "thing", main),
          columns_(columns),
          rows_(rows),
          phase_(Random(request.seed).between(0.0, 2.0 * M_PI))
    {
    }

    void write()
    {
        for (int j = 0; j < rows_; ++j)
            for (int i = 0; i < columns_; ++i) {
                if (j > 0) triangle({i, i + 1, i + 1}, {j, j, j + 1});
                if (j + 1 < rows_) triangle({i, i + 1, i}, {j, j + 1, j + 1});
            }
        files_.finish();
    }

private:
    void triangle(const std::array<int, 3>& column, const std::array<int, 3>& row)
    {
        std::array<DeformingKey, shapes> keys;
        std::array<DeformingNormals, shapes> normals;
        for (std::size_t k = 0; k < shapes; ++k) {
            keys[k].time = static_cast<double>(k) * seconds_per_shape;
            for (std::size_t c = 0; c < 3; ++c) {
                const double u = static_cast<double>(column[c] % columns_) / columns_,
                             v = static_cast<double>(row[c]) / rows_;
                const glm::dvec3 p = point(all_shapes[k], phase_, u, v), n = normal(all_shapes[k], phase_, u, v);
                for (int axis = 0; axis < 3; ++axis) {
                    keys[k].position[c][axis] = cut(p[axis], 1e-4);
                    normals[k].corner[c][axis] = static_cast<float>(cut(n[axis], 1e-2));
                }
            }
        }
        files_.out().deforming_triangle(keys, normals);
    }

    SplitWriter files_;
    int columns_, rows_;
    double phase_;
};

void write_settings(AffWriter& out)
{
    constexpr double seconds = (shapes - 1) * seconds_per_shape;
    const auto eye = [](double t) {
        const double angle = 0.62 - 0.13 * t;
        return glm::dvec3(4.1 * std::sin(angle), 1.85, 4.1 * std::cos(angle));
    };
    const auto target = [](double) { return glm::dvec3(0.0, 1.52, 0.0); };
    out.view({.from = eye(0.0), .at = target(0.0), .angle = 48.0, .hither = 0.05, .width = 800, .height = 600});
    out.frames(0.0, seconds, 144);
    out.background({0.0f, 0.0f, 0.0f});
    out.ambient({0.40f, 0.38f, 0.36f});
    out.light({3.4, 4.5, 3.2}, {0.56f, 0.52f, 0.46f});
    out.light({-3.0, 4.6, 2.0}, {0.34f, 0.35f, 0.38f});
    out.keys(motion("camera", {0.0, seconds, 12}, eye, [&](double t) { return looking(eye(t), target(t)); }));
}

}  // namespace

/// Every triangle moves its own way: a structure can be refitted or built anew, but nothing keeps its shape.
std::uint64_t write_art(const Request& request)
{
    AffWriter out(request.file);
    out.comment("A thing of glazed clay that changes its shape in a gallery. Made by firstray's generator; CC0.");
    write_settings(out);
    write_gallery(out, request);
    const double left =
        request.amount - static_cast<double>(out.triangles());  // 2 columns (rows - 1), rows = columns / 2
    const int columns = std::max(8, static_cast<int>(std::lround(std::sqrt(left))));
    const int rows = std::max(4, static_cast<int>(std::lround(left / (2.0 * columns))) + 1);
    out.material(glossy({0.10f, 0.24f, 0.52f}, 0.20f, 60.0f));
    ThingWriter(request, out, columns, rows).write();
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
