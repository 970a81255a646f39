#include <array>
#include <cmath>
#include <limits>
#include <sstream>

#include "bench/strategies.h"
#include "engine/core/errors.h"
#include "engine/scene/pose.h"
#include "tests/fuzz/targets.h"
#include "tests/support/compare_hits.h"
#include "tests/support/scene_files.h"

namespace firstray::fuzz {
namespace {

using test::TestRay;

/// Numbers where structures go wrong: on a lattice, next to it, tiny, huge.
double coordinate(Taking& in)
{
    const unsigned kind = in.byte();
    const double lattice = 0.5 * (static_cast<double>(kind % 17) - 8.0);
    if (kind < 190) return lattice;
    if (kind < 210) return lattice + 0x1p-22 * (static_cast<double>(kind) - 200.0);
    if (kind < 225) return std::ldexp(lattice, static_cast<int>(kind) - 217);
    if (kind < 240) return lattice * static_cast<double>(in.byte()) / 255.0;
    constexpr double special[] = {1e-30, 1e30, -1e30,   3e38, 1e-12, -1e-12, 1e6,  -1e6,
                                  1e9,   0.1,  1.0 / 3, 7.0,  -7.0,  1e15,   1e18, -0.0};
    return special[kind - 240];
}

glm::dvec3 point(Taking& in)
{
    const double x = coordinate(in), y = coordinate(in), z = coordinate(in);
    return {x, y, z};
}

std::ostream& operator<<(std::ostream& out, const glm::dvec3& p)
{
    return out << p.x << ' ' << p.y << ' ' << p.z << ' ';
}

/// Writes a scene of a few primitives, some of which move.
class SceneText {
public:
    explicit SceneText(Taking& in) : in_(in) { text_.precision(17); }

    std::string write()
    {
        text_ << "a 0 4 5\n";
        primitives();
        for (unsigned i = 0, movers = in_.below(4); i < movers; ++i) mover(i);
        return text_.str();
    }

private:
    void primitives()
    {
        for (unsigned left = in_.below(12); left > 0; --left) primitive();
    }

    void primitive()
    {
        switch (in_.below(12)) {
            case 0:
                text_ << "fm 0 0 0 1 1 1 0 0 0 0 " << 0.5 * in_.below(2) << " 0\n";
                return;
            case 1:
                text_ << "s " << point(in_) << radius() << '\n';
                return;
            case 2: {
                const glm::dvec3 base = point(in_);
                text_ << "c " << base << radius() << ' ' << base + glm::dvec3(0, 0, 1) << radius() << '\n';
                return;
            }
            case 3:
                text_ << "tpa 2 ";
                for (int key = 0; key < 2; ++key) {
                    text_ << 2 * key << ' ';
                    for (int k = 0; k < 3; ++k) text_ << point(in_) << "0 0 1 ";
                }
                text_ << '\n';
                return;
            case 4:
                lattice();
                return;
            default:
                text_ << "p 3 " << corner() << corner() << corner() << '\n';
        }
    }

    /// A flat mesh whose edges lie where cells' borders like to be.
    void lattice()
    {
        const unsigned side = 2 + in_.below(4);
        const glm::dvec3 from = point(in_);
        for (unsigned i = 0; i < side * side; ++i) {
            const glm::dvec3 a = from + glm::dvec3(i % side, i / side, 0);
            text_ << "p 4 " << a << a + glm::dvec3(1, 0, 0) << a + glm::dvec3(1, 1, 0) << a + glm::dvec3(0, 1, 0)
                  << '\n';
        }
    }

    double radius() { return 0.125 * (1 + in_.below(16)); }

    /// A new point, or one that was there: triangles share corners then.
    glm::dvec3 corner()
    {
        if (!corners_.empty() && in_.below(3) == 0) return corners_[in_.below(static_cast<unsigned>(corners_.size()))];
        corners_.push_back(point(in_));
        return corners_.back();
    }

    void mover(unsigned number)
    {
        text_ << "x m" << number << " {\n";
        primitives();
        if (in_.below(3) == 0) {
            text_ << "xs 1 1 1 0 1 0 " << 15 * in_.below(24) << ' ' << point(in_) << "{\n";
            primitives();
            text_ << "}\n";
        }
        text_ << "}\nk m" << number << " {\n";
        track("transl", false);
        if (in_.below(2) == 0) track("rot", true);
        if (in_.below(3) == 0) track("scale", false);
        text_ << "}\n";
    }

    void track(const char* name, bool has_angle)
    {
        text_ << name << " 6 ";
        for (int key = -1; key < 5; ++key) {
            text_ << key << ' ' << point(in_);
            if (has_angle) text_ << 15 * static_cast<int>(in_.below(48)) - 360 << ' ';
            text_ << "0 0 0\n";
        }
    }

    Taking& in_;
    std::ostringstream text_;
    std::vector<glm::dvec3> corners_;
};

/// From anywhere towards anywhere, corners among them.
std::vector<TestRay> rays_of(Taking& in, const Scene& scene, bool from_one)
{
    const auto target = [&] {
        return scene.positions.empty() || in.below(3) == 0 ? point(in)
                                                           : scene.positions[in.byte() % scene.positions.size()];
    };
    std::vector<TestRay> rays;
    glm::dvec3 from = point(in);
    for (int i = 0; i < 64; ++i) {
        if (!from_one) from = point(in);
        rays.push_back({from, 0.5 * (target() + target()) - from});
        if (in.below(8) == 0) rays.back().direction[static_cast<int>(in.below(3))] = 0.0;
        if (in.below(8) == 0) rays.back().t_max = coordinate(in);
    }
    return rays;
}

/// Costs that are told, not measured: the same choices every time.
StrategyOptions options_for(const StrategyEntry& entry, StrategyOptions options)
{
    if (entry.name == "adaptive") options.own = {{"costs", "test=1,pack=1,building=2,making=20"}};
    return options;
}

template <typename Real>
using Make = std::unique_ptr<Strategy<Real>> (*)(const Scene&, const StrategyOptions&);

template <typename Real>
Make<Real> maker(const StrategyEntry& entry)
{
    if constexpr (std::is_same_v<Real, float>)
        return entry.make;
    else
        return entry.make_double;
}

template <typename Real>
void compare(const Scene& scene, const std::vector<double>& times, const std::vector<TestRay>& rays,
             const StrategyOptions& options)
{
    std::vector<Pose> poses;
    std::vector<test::Expected<Real>> expected;
    const auto list = maker<Real>(*find_strategy("list"))(scene, options);
    for (const double time : times) poses.push_back(pose(scene, time));
    for (const Pose& now : poses) {
        list->update(now);
        expected.emplace_back(*list, rays);
    }
    for (const StrategyEntry& entry : firstray::strategies()) {
        if (entry.peer || entry.name == "list") continue;
        const auto strategy = maker<Real>(entry)(scene, options_for(entry, options));
        for (std::size_t i = 0; i < poses.size(); ++i) {
            strategy->update(poses[i]);
            int hits = 0;
            if (const int different = expected[i].differences(*strategy, hits); different != 0)
                throw Finding(std::string(entry.name) + " differs from list for " + std::to_string(different) +
                              " rays");
        }
    }
}

}  // namespace

void strategies(Bytes input)
{
    Taking in(input);
    const unsigned kind = in.byte();
    const Precision precision = std::array{Precision::robust, Precision::fast, Precision::double_}[kind % 3];
    const StrategyOptions options{.precision = precision, .max_list = 1 + static_cast<int>(kind / 3 % 4)};
    Scene scene;
    try {
        scene = test::scene_of(SceneText(in).write());
    } catch (const Error&) {
        return;  // a point too far out
    }
    const std::vector<double> times = {0.5 * in.below(9), 0.5 * in.below(9)};
    const std::vector<TestRay> rays = rays_of(in, scene, kind >= 128);
    if (precision == Precision::double_)
        compare<double>(scene, times, rays, options);
    else
        compare<float>(scene, times, rays, options);
}

}  // namespace firstray::fuzz
