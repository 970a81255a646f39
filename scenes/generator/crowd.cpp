#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "scenes/generator/generate.h"
#include "scenes/generator/ground.h"
#include "scenes/generator/looks.h"
#include "scenes/generator/motion.h"
#include "scenes/generator/split_writer.h"
#include "scenes/generator/texture_maker.h"
#include "scenes/generator/town.h"

namespace firstray::scenes {
namespace {

// Lengths in metres, y up. Streets run along z and x; the camera stands in the one along z at x = 0.
constexpr double block_x = 36.0, block_z = 62.0, half_street = 4.5;
constexpr int lots_per_row = 5, person_models = 6, tree_models = 4;
constexpr double built_share = 0.72;        // of the triangles; the rest is ground
constexpr double triangles_per_row = 18e3;  // about: only the hills' distance depends on it
constexpr double lot_width = (block_z - 2.0 * half_street) / lots_per_row;

enum Kind : std::uint64_t { row_kind = 1, person_kind, tree_kind, walker_kind };

/// Houses along one side of a block, their fronts towards the street at its low or its high x.
struct Row {
    int x = 0, z = 0;  // of the block
    bool high_side = false;
    double distance = 0.0;  // from a place before the camera

    double front() const { return high_side ? (x + 1) * block_x - half_street : x * block_x + half_street; }
};

/// Rows from the camera outwards, more than the triangles will suffice for; the square before the church stays free.
std::vector<Row> rows_around(double wanted)
{
    const int reach = static_cast<int>(std::sqrt(wanted * block_z / block_x)) + 3;
    std::vector<Row> rows;
    for (int z = -reach; z < reach; ++z)
        for (int x = -reach; x < reach; ++x)
            for (const bool high_side : {false, true}) {
                Row row{x, z, high_side};
                row.distance = std::hypot(row.front(), (z + 0.5) * block_z - 12.0);
                if (z != -2 || x < -1 || x > 0) rows.push_back(row);
            }
    std::sort(rows.begin(), rows.end(), [](const Row& a, const Row& b) {
        return std::tie(a.distance, a.z, a.x) < std::tie(b.distance, b.z, b.x);
    });
    return rows;
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

/// Writes what the town consists of.
class TownWriter {
public:
    TownWriter(const Request& request, const Ground& ground, const Models& models, AffWriter& main)
        : request_(request),
          ground_(ground),
          models_(models),
          files_(request, "town", main),
          plaster_(request.name("plaster.ppm"))
    {
    }

    std::uint64_t triangles() const { return files_.triangles(); }
    void finish() { files_.finish(); }

    /// Stops when there are `enough` triangles.
    void row(const Row& row, std::uint64_t enough)
    {
        const int place = (row.x * 65536 + row.z) * 2 + row.high_side;
        Random random(request_.seed, row_kind, static_cast<std::uint64_t>(place));
        for (int lot = 0; lot < lots_per_row && triangles() < enough; ++lot) {
            house(row, lot, random);
            for (int i = 0; i < 2; ++i) person_in_street(row, random);
            if (lot % 2 == 1 && triangles() < enough) tree(row, lot, random);
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

private:
    void person(const glm::dvec3& place, double degrees, Random& random)
    {
        const auto model = static_cast<std::size_t>(random.below(person_models));
        AffWriter& out = files_.out();
        out.material(matt(bright_colour(random)));
        include(out, models_.people[model], models_.person_triangles[model], place, degrees,
                random.between(0.92, 1.06));
    }

    void include(AffWriter& out, const std::string& name, std::uint64_t triangles, const glm::dvec3& place,
                 double degrees, double size)
    {
        const auto cut = [](double x) { return std::round(x * 100.0) / 100.0; };
        out.open({.scale = glm::dvec3(cut(size)),
                  .degrees = std::round(degrees),
                  .offset = {cut(place.x), cut(place.y), cut(place.z)}});
        out.include(name, triangles);
        out.close();
        out.forget_material();
    }

    void house(const Row& row, int lot, Random& random)
    {
        const double z = row.z * block_z + half_street + (lot + 0.5) * lot_width;
        const House house{.width = lot_width, .depth = random.between(8.4, 9.6), .storeys = 2 + random.below(3)};
        const Transform place = shift(ground_.on(row.front(), z)) * turn({0, 1, 0}, row.high_side ? 90 : -90);
        write_house(files_.out(), house, place, plaster_, random);
    }

    void person_in_street(const Row& row, Random& random)
    {
        const bool along_z = random.chance(0.7);
        const double side = random.between(0.3, 3.6), way = random.unit(), degrees = random.between(0.0, 360.0);
        const double inwards = row.high_side ? 1.0 : -1.0, middle = row.front() + inwards * half_street;
        const double x = along_z ? middle - inwards * side : middle - inwards * way * block_x / 2;
        const double z = row.z * block_z + (along_z ? way * block_z : inwards * side);
        const bool before_camera = std::abs(x) < 2.0 && z > 20.0 && z < 60.0;
        person(ground_.on(x + (before_camera ? std::copysign(2.0, x) : 0.0), z), degrees, random);
    }

    /// In the garden behind the houses.
    void tree(const Row& row, int lot, Random& random)
    {
        const double x = (row.x + 0.5) * block_x + (row.high_side ? 2.0 : -2.0) + random.between(-1.5, 1.5);
        const double z = row.z * block_z + half_street + (lot + random.unit()) * lot_width;
        const double degrees = random.between(0.0, 360.0), size = random.between(0.8, 1.2);
        const auto model = static_cast<std::size_t>(random.below(tree_models));
        include(files_.out(), models_.trees[model], models_.tree_triangles[model], ground_.on(x, z), degrees, size);
    }

    const Request& request_;
    const Ground& ground_;
    const Models& models_;
    SplitWriter files_;
    std::string plaster_;
};

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
    const double rows = request.amount * built_share / triangles_per_row;
    const Ground ground(std::sqrt(0.5 * rows * block_x * block_z / M_PI) + 60.0, request.seed);
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
    for (const Row& row : rows_around(rows))
        if (town.triangles() < built) town.row(row, built);
    town.finish();
    write_ground(request, ground, wanted - std::min(wanted, out.triangles()), out);
    out.finish();
    return out.triangles();
}

}  // namespace firstray::scenes
