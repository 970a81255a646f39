#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "scenes/generator/generate.h"
#include "scenes/generator/looks.h"
#include "scenes/generator/motion.h"
#include "scenes/generator/texture_maker.h"
#include "scenes/generator/town.h"

namespace firstray::scenes {
namespace {

// Lengths in metres, y up. Streets run along z and x; the camera stands in the one along z at x = 0.
constexpr double block_x = 36.0, block_z = 62.0, half_street = 4.5;
constexpr int lots_per_row = 5, person_models = 6, tree_models = 4;
constexpr double built_share = 0.72;          // of the triangles; the rest is ground
constexpr double triangles_per_block = 16e3;  // about: only the hills' distance depends on it
constexpr double hills_width = 450.0;
constexpr std::uint64_t file_bytes = 200u
                                     << 20;  // a file of the town is closed beyond this: readers hold one at a time
constexpr double lot_width = (block_z - 2.0 * half_street) / lots_per_row;

enum Kind : std::uint64_t { block_kind = 1, person_kind, tree_kind, walker_kind, ground_kind };

struct Block {
    int x = 0, z = 0;
    double distance = 0.0;  // of its middle from the camera's street
};

/// The ground: gentle waves in the town, hills around it.
class Ground {
public:
    Ground(double town_radius, std::uint64_t seed) : town_radius_(town_radius), seed_(Random::mixed(seed)) {}

    double extent() const { return town_radius_ + hills_width; }
    bool in_town(double x, double z) const { return std::hypot(x, z) < town_radius_; }
    double height(double x, double z) const
    {
        const double waves = 0.8 * std::sin(x / 31.0 + 1.0) * std::cos(z / 43.0);
        const double rise = ease(town_radius_, town_radius_ + 0.8 * hills_width, std::hypot(x, z));
        if (rise <= 0.0) return waves;
        const double shape = clouds(x / 170.0 + 100.0, z / 170.0 + 100.0, 1 << 20, 4, seed_);
        return waves + rise * (25.0 + 150.0 * shape * shape);
    }
    glm::dvec3 on(double x, double z) const { return {x, height(x, z), z}; }

private:
    double town_radius_;
    std::uint64_t seed_;
};

/// Blocks from the middle outwards, more than the triangles will suffice for; the square before the church stays free.
std::vector<Block> blocks_around(double wanted)
{
    const int reach = static_cast<int>(std::sqrt(wanted * block_z / block_x)) + 3;
    std::vector<Block> blocks;
    for (int z = -reach; z < reach; ++z)
        for (int x = -reach; x < reach; ++x) {
            const bool square = z == -2 && (x == -1 || x == 0);
            if (!square) blocks.push_back({x, z, std::hypot((x + 0.5) * block_x, (z + 0.5) * block_z)});
        }
    std::sort(blocks.begin(), blocks.end(), [](const Block& a, const Block& b) {
        return std::tie(a.distance, a.z, a.x) < std::tie(b.distance, b.z, b.x);
    });
    return blocks;
}

/// Models that the town includes again and again.
struct Models {
    std::vector<std::string> people, trees;
    std::vector<std::uint64_t> person_triangles, tree_triangles;
};

Models write_models(const Request& request)
{
    Models models;
    const auto add = [&](const char* kind, int index, std::uint64_t seed_kind, auto&& write, auto& names, auto& sizes) {
        const std::string rest = std::string(kind) + "_" + std::to_string(index) + ".aff";
        AffWriter out(request.beside(rest));
        Random random(request.seed, seed_kind, static_cast<std::uint64_t>(index));
        write(out, random);
        out.finish();
        names.push_back(request.name(rest));
        sizes.push_back(out.triangles());
    };
    for (int i = 0; i < person_models; ++i)
        add("person", i, person_kind, write_person, models.people, models.person_triangles);
    for (int i = 0; i < tree_models; ++i) add("tree", i, tree_kind, write_tree, models.trees, models.tree_triangles);
    return models;
}

/// Writes the town into as many files as it takes, each of which the main file includes.
class TownWriter {
public:
    TownWriter(const Request& request, const Ground& ground, const Models& models, AffWriter& main)
        : request_(request), ground_(ground), models_(models), main_(main), plaster_(request.name("plaster.ppm"))
    {
        next_file();
    }

    std::uint64_t triangles() const { return main_.triangles() + out_->triangles(); }

    /// Stops when there are `enough` triangles.
    void block(const Block& block, std::uint64_t enough)
    {
        if (out_->bytes() > file_bytes) next_file();
        Random random(request_.seed, block_kind, static_cast<std::uint64_t>(block.x * 65536 + block.z));
        for (int lot = 0; lot < 2 * lots_per_row && triangles() < enough; ++lot) {
            house(block, lot, random);
            person_in_street(block, random);
            if (lot % 3 == 0 && triangles() < enough) tree(block, lot, random);
        }
    }

    /// On the square and in the street before the camera, out of its way.
    void people_in_sight()
    {
        Random random(request_.seed, person_kind, person_models);
        for (int i = 0; i < 60; ++i) {
            const bool square = i % 2 == 0;
            const double x =
                square ? random.between(-22.0, 22.0) : std::copysign(random.between(1.6, 3.6), i % 4 - 2.0);
            const double z = square ? random.between(-92.0, -66.0) : random.between(-60.0, 36.0);
            const double degrees = random.between(0.0, 360.0);
            if (std::hypot(x, z + 80.0) > 5.0) person(ground_.on(x, z), degrees, random);
        }
    }

    void finish()
    {
        main_.include(name_, out_->triangles());
        out_->finish();
        out_.reset();
    }

private:
    void person(const glm::dvec3& place, double degrees, Random& random)
    {
        const auto model = static_cast<std::size_t>(random.below(person_models));
        out_->material(matt(bright_colour(random)));
        const double size = std::round(random.between(0.92, 1.06) * 100.0) / 100.0;
        include(models_.people[model], models_.person_triangles[model], place, degrees, size);
    }

    void next_file()
    {
        if (out_) finish();
        const std::string rest = "town_" + std::to_string(files_++) + ".aff";
        name_ = request_.name(rest);
        out_.emplace(request_.beside(rest));
    }

    void include(const std::string& name, std::uint64_t triangles, const glm::dvec3& place, double degrees, double size)
    {
        const auto cut = [](double x) { return std::round(x * 1000.0) / 1000.0; };
        out_->open({.scale = glm::dvec3(size),
                    .degrees = std::round(degrees),
                    .offset = {cut(place.x), cut(place.y), cut(place.z)}});
        out_->include(name, triangles);
        out_->close();
        out_->forget_material();
    }

    /// Lots 0 ... 4 face the street at the block's low x, 5 ... 9 that at its high x.
    void house(const Block& block, int lot, Random& random)
    {
        const bool high_side = lot >= lots_per_row;
        const double x = high_side ? (block.x + 1) * block_x - half_street : block.x * block_x + half_street;
        const double z = block.z * block_z + half_street + (lot % lots_per_row + 0.5) * lot_width;
        const House house{.width = lot_width, .depth = random.between(8.4, 9.6), .storeys = 2 + random.below(3)};
        const Transform place = shift(ground_.on(x, z)) * turn({0, 1, 0}, high_side ? 90 : -90);
        write_house(*out_, house, place, plaster_, random);
    }

    void person_in_street(const Block& block, Random& random)
    {
        const bool along_z = random.chance(0.7);
        const double side = random.between(-3.4, 3.4), way = random.unit();
        const double x = block.x * block_x + (along_z ? side : way * block_x);
        const double z = block.z * block_z + (along_z ? way * block_z : side);
        const bool before_camera = std::abs(x) < 2.0 && z > 20.0 && z < 60.0;
        person(ground_.on(x + (before_camera ? std::copysign(2.0, x) : 0.0), z), random.between(0.0, 360.0), random);
    }

    void tree(const Block& block, int lot, Random& random)
    {
        const double x = (block.x + 0.5) * block_x + random.between(-2.0, 2.0);
        const double z = block.z * block_z + half_street + (lot + 0.5) * lot_width / 2 + random.between(-1.5, 1.5);
        const auto model = static_cast<std::size_t>(random.below(tree_models));
        include(models_.trees[model], models_.tree_triangles[model], ground_.on(x, z), random.between(0.0, 360.0),
                std::round(random.between(0.8, 1.2) * 100.0) / 100.0);
    }

    const Request& request_;
    const Ground& ground_;
    const Models& models_;
    AffWriter& main_;
    std::string plaster_, name_;
    std::optional<AffWriter> out_;
    int files_ = 0;
};

/// The triangles of a patch that lie in the town, or those that do not.
void write_patch(AffWriter& out, const Mesh& patch, const Ground& ground, bool town, const std::string& texture)
{
    Mesh part = part_of(patch, [&](const glm::dvec3& p) { return ground.in_town(p.x, p.z) == town; });
    if (part.triangles.empty()) return;
    for (const glm::dvec3& p : part.positions) part.uvs.push_back(glm::dvec2(p.x, p.z) / (town ? 4.0 : 60.0));
    for (Mesh::Triangle& t : part.triangles) t.uv = t.vertex;
    snap(part, 1e-2);
    if (town) part.normals.clear();  // nearly flat
    out.material(matt(town ? glm::vec3(0.80f, 0.76f, 0.72f) : glm::vec3(0.78f, 0.82f, 0.74f)));
    out.mesh(part, texture);
}

/// Ground of about `triangles` triangles, cut into patches.
std::uint64_t write_ground(const Request& request, const Ground& ground, std::uint64_t triangles, AffWriter& main)
{
    constexpr int patch = 30;  // less than 1000 vertices: indices of three digits
    const int cells = std::max(8, static_cast<int>(std::lround(std::sqrt(static_cast<double>(triangles) / 2.0))));
    const double cell = 2.0 * ground.extent() / cells;
    AffWriter out(request.beside("ground.aff"));
    for (int j = 0; j < cells; j += patch)
        for (int i = 0; i < cells; i += patch) {
            const int nu = std::min(patch, cells - i), nv = std::min(patch, cells - j);
            const Mesh mesh = surface(nu, nv, [&](double u, double v) {
                return ground.on((i + u * nu) * cell - ground.extent(), ground.extent() - (j + v * nv) * cell);
            });
            write_patch(out, mesh, ground, true, request.name("cobbles.ppm"));
            write_patch(out, mesh, ground, false, request.name("meadow.ppm"));
        }
    out.finish();
    main.include(request.name("ground.aff"), out.triangles());
    return out.triangles();
}

void write_settings(AffWriter& out, const Ground& ground)
{
    constexpr double seconds = 8.0;
    const auto eye = [&](double t) { return ground.on(-1.2 + 0.2 * t, 46.0 - 1.1 * t) + glm::dvec3(0.0, 3.4, 0.0); };
    const auto front = [&](double t) { return looking(eye(t), {0.4 * std::sin(t / 3.0), 6.2, -60.0}); };
    out.view({.from = eye(0.0), .at = {0.0, 6.2, -60.0}, .angle = 46.0, .hither = 0.1, .width = 800, .height = 600});
    out.frames(0.0, seconds, 192);
    out.background({0.60f, 0.76f, 0.95f});
    out.ambient({0.46f, 0.49f, 0.57f});
    out.light({-0.9e4, 2.0e4, 1.6e4}, {0.84f, 0.74f, 0.56f});
    out.keys(motion("camera", {0.0, seconds, 8}, eye, front));
}

void write_balloons(AffWriter& out)
{
    const struct {
        glm::dvec3 from, way;
        glm::vec3 colour;
    } balloons[] = {{{-14.0, 52.0, -150.0}, {1.6, 0.5, 0.2}, {0.80f, 0.20f, 0.15f}},
                    {{24.0, 70.0, -260.0}, {-1.2, 0.3, 0.6}, {0.15f, 0.40f, 0.62f}},
                    {{-40.0, 105.0, -420.0}, {1.4, -0.3, 0.5}, {0.92f, 0.62f, 0.12f}}};
    int index = 0;
    for (const auto& b : balloons) {
        const std::string name = "balloon_" + std::to_string(index++);
        out.keys(motion(
            name, {0.0, 8.0, 8}, [&](double t) { return b.from + t * b.way; },
            [&](double t) {
                return rotation_about({0, 1, 0}, 0.12 * t + index);
            }));
        out.open(name);
        write_balloon(out, b.colour);
        out.close();
    }
}

/// People who walk up and down the camera's street.
void write_walkers(AffWriter& out, const Request& request, const Ground& ground, const Models& models)
{
    for (std::uint64_t i = 0; i < 8; ++i) {
        Random random(request.seed, walker_kind, i);
        const double x = random.between(1.0, 3.2) * (i % 2 ? 1.0 : -1.0),
                     z = 30.0 - 11.0 * static_cast<double>(i) + random.between(-2.0, 2.0);
        const double speed = (i % 2 ? -1.0 : 1.0) * random.between(0.9, 1.4);
        const std::string name = "walker_" + std::to_string(i);
        const auto place = [&](double t) {
            return ground.on(x, z + speed * t) + glm::dvec3(0.0, 0.04 * std::abs(std::sin(4.0 * t)), 0.0);
        };
        const auto front = [&](double t) {
            return rotation_about({0, 1, 0}, speed > 0.0 ? 0.0 : M_PI) *
                   rotation_about({0, 0, 1}, 0.05 * std::sin(4.0 * t));
        };
        out.keys(motion(name, {0.0, 8.0, 64}, place, front));
        out.material(matt(bright_colour(random)));
        out.open(name);
        const std::size_t model = i % models.people.size();
        out.include(models.people[model], models.person_triangles[model]);
        out.close();
        out.forget_material();
    }
}

}  // namespace

std::uint64_t write_crowd(const Request& request)
{
    const auto wanted = static_cast<std::uint64_t>(request.amount);
    const auto built = static_cast<std::uint64_t>(request.amount * built_share);
    const double blocks = request.amount * built_share / triangles_per_block;
    const Ground ground(std::sqrt(blocks * block_x * block_z / M_PI) + 60.0, request.seed);
    write_cobbles(request.beside("cobbles.ppm"), request.seed);
    write_meadow(request.beside("meadow.ppm"), request.seed);
    write_plaster(request.beside("plaster.ppm"), request.seed);
    const Models models = write_models(request);

    AffWriter out(request.file);
    out.comment(
        "A town among hills, most of it out of sight; balloons and people move. Made by firstray's generator; CC0.");
    write_settings(out, ground);
    write_balloons(out);
    write_walkers(out, request, ground, models);
    write_church(out, shift(ground.on(0.0, -98.0)), request.name("plaster.ppm"));
    write_fountain(out, shift(ground.on(0.0, -80.0)));
    TownWriter town(request, ground, models, out);
    town.people_in_sight();
    for (const Block& block : blocks_around(blocks))
        if (town.triangles() < built) town.block(block, built);
    town.finish();
    write_ground(request, ground, wanted - std::min(wanted, out.triangles()), out);
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
