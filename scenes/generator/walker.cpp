#include "scenes/generator/walker.h"

#include <cmath>

#include "scenes/generator/gait.h"
#include "scenes/generator/walker_parts.h"

namespace firstray::scenes {
namespace {

/// Opens and closes the transforms of one walker.
class WalkerWriter {
public:
    WalkerWriter(AffWriter& out, const std::string& name, const Walk& walk, const WalkerParts& parts)
        : out_(out), name_(name), walk_(walk), parts_(parts)
    {
    }

    void write()
    {
        const auto heading = [this](double t) { return rotation_about({0, 1, 0}, glm::radians(walk_.heading(t))); };
        out_.keys(motion(name_, walk_.beat, walk_.place, heading));
        out_.open(name_);
        const auto hip_place = [this](double t) { return glm::dvec3(0.0, hip_height(phase(t)), 0.0); };
        const auto hip_turn = [this](double t) { return hips_turn(phase(t)); };
        out_.keys(motion(name_ + "_hips", walk_.beat, hip_place, hip_turn));
        out_.open(name_ + "_hips");
        draw(parts_.hips);
        torso();
        for (const bool left : {true, false}) leg(left);
        out_.close();
        out_.close();
    }

private:
    double phase(double t) const { return phase_after(walk_.travelled(t)); }

    void draw(const std::vector<PaintedMesh>& meshes)
    {
        for (const PaintedMesh& painted : meshes) {
            out_.material(painted.material);
            out_.mesh(painted.mesh);
        }
    }

    /// A joint at `place` of its parent that turns by turn(phase, time); everything up to close_joint() hangs from it.
    void open_joint(const std::string& part, const glm::dvec3& place,
                    const std::function<glm::dmat3(double, double)>& turn)
    {
        const std::string name = name_ + "_" + part;
        out_.keys(motion(name, walk_.beat, {}, [&](double t) { return turn(phase(t), t); }));
        out_.open({.offset = place});
        out_.open(name);
    }

    void close_joints(int count)
    {
        for (int i = 0; i < 2 * count; ++i) out_.close();
    }

    void torso()
    {
        open_joint("torso", {0, 0.10, 0}, [](double p, double) { return torso_turn(p); });
        draw(parts_.torso);
        open_joint("head", {0, 0.56, 0}, [](double, double t) { return head_turn(t); });
        draw(parts_.head);
        open_joint("antenna", {0.0, 0.30, 0.0}, [](double p, double) { return antenna_turn(p); });
        draw(parts_.antenna);
        close_joints(2);
        for (const bool left : {true, false}) arm(left);
        close_joints(1);
    }

    void arm(bool left)
    {
        const std::string side = left ? "left" : "right";
        const double x = left ? 0.30 : -0.30, shift = left ? M_PI : 0.0;  // an arm swings with the other side's leg
        open_joint("upper_arm_" + side, {x, 0.43, 0},
                   [=](double p, double) { return upper_arm_turn(p + shift, left); });
        draw(parts_.upper_arm);
        open_joint("forearm_" + side, {0, -0.28, 0}, [=](double p, double) { return forearm_turn(p + shift); });
        draw(parts_.forearm);
        open_joint("hand_" + side, {0, -0.26, 0}, [=](double p, double) { return hand_turn(p + shift, left); });
        draw(parts_.hand);
        close_joints(3);
    }

    void leg(bool left)
    {
        const std::string side = left ? "left" : "right";
        const double x = left ? 0.13 : -0.13, shift = left ? 0.0 : M_PI;
        const auto bend = [=](double LegBend::*angle) {
            return [=](double p, double) { return rotation_about({1, 0, 0}, leg_bend(p + shift, p).*angle); };
        };
        open_joint("thigh_" + side, {x, 0, 0}, bend(&LegBend::hip));
        draw(parts_.thigh);
        open_joint("shin_" + side, {0, -thigh_length, 0}, bend(&LegBend::knee));
        draw(parts_.shin);
        open_joint("foot_" + side, {0, -shin_length, 0}, bend(&LegBend::ankle));
        draw(parts_.foot);
        open_joint("toe_" + side, {0, -0.075, 0.13}, bend(&LegBend::toe));
        draw(parts_.toe);
        close_joints(4);
    }

    AffWriter& out_;
    std::string name_;
    const Walk& walk_;
    const WalkerParts& parts_;
};

}  // namespace

std::uint64_t write_walker(AffWriter& out, const std::string& name, const Walk& walk, const Paint& paint)
{
    const std::uint64_t before = out.triangles();
    const WalkerParts parts = walker_parts(paint);
    WalkerWriter(out, name, walk, parts).write();
    return out.triangles() - before;
}

Walk circle_walk(const Beat& beat, double radius, double speed, double from)
{
    const auto angle = [=](double t) { return glm::radians(from) + speed * t / radius; };
    return {beat, [=](double t) { return radius * glm::dvec3(std::sin(angle(t)), 0.0, std::cos(angle(t))); },
            [=](double t) { return glm::degrees(angle(t)) + 90.0; }, [=](double t) { return speed * t; }};
}

}  // namespace firstray::scenes
