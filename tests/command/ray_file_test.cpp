#include "bench/firstray/ray_file.h"

#include <doctest/doctest.h>

#include <cmath>
#include <sstream>

#include "engine/core/errors.h"

namespace firstray::command {
namespace {

std::vector<WorldRay> parse(const std::string& text)
{
    std::istringstream in(text);
    return parse_rays(in, "rays.csv");
}

TEST_CASE("rays are read one a line, past a header, comments, blank lines and line ends of other systems")
{
    const auto rays = parse(
        "# ten metres up\n\nox,oy,oz,dx,dy,dz,tmin,tmax\n1,2,3,4,5,6,7,inf\r\n  \n"
        " -0.5 , 1e-3,.25,0,0,-1,0, 9.5\n#end\n1,1,1,1,1,1,0,1");
    REQUIRE(rays.size() == 3);
    CHECK(rays[0].origin == glm::dvec3(1, 2, 3));
    CHECK(rays[0].direction == glm::dvec3(4, 5, 6));
    CHECK(rays[0].t_min == 7);
    CHECK(std::isinf(rays[0].t_max));
    CHECK(rays[1].origin == glm::dvec3(-0.5, 1e-3, 0.25));
    CHECK(rays[1].t_max == 9.5);
}

TEST_CASE("a malformed ray is a scene fault with its line and column")
{
    const std::pair<std::string, std::string> cases[] = {
        {"1,2,3,4,5,6,7\n", "rays.csv:1:14: 7 fields, expected 8 fields: ox,oy,oz,dx,dy,dz,tmin,tmax"},
        {"\n1,2,3,4,5,6,7,8,9\n", "rays.csv:2:17: 9 fields, expected 8 fields: ox,oy,oz,dx,dy,dz,tmin,tmax"},
        {"1,2, x3,4,5,6,7,8\n", "rays.csv:1:6: 'x3', expected a finite number"},
        {"1,,3,4,5,6,7,8\n", "rays.csv:1:3: '', expected a finite number"},
        {"inf,2,3,4,5,6,7,8\n", "rays.csv:1:1: 'inf', expected a finite number"},
        {"1,2,3,4,nan,6,7,8\n", "rays.csv:1:9: 'nan', expected a finite number"},
        {"1,2,3,4,5,1e999,7,8\n", "rays.csv:1:11: '1e999', expected a finite number"},
        {"1,2,3,4,5,6,7,-inf\n", "rays.csv:1:15: '-inf', expected a number or inf"},
        {"1,2,3,4,5,6,7,nan\n", "rays.csv:1:15: 'nan', expected a number or inf"},
        {"1,2,3,4,5,6,7,8x\n", "rays.csv:1:15: '8x', expected a number or inf"},
    };
    for (const auto& [text, message] : cases) {
        const auto text_now = text;  // clang 14 captures no structured bindings
        CAPTURE(text_now);
        CHECK_THROWS_WITH_AS(parse(text), message.c_str(), SceneError);
    }
    CHECK_THROWS_AS(parse("1,2,3,4,5,6,7,8\nox,oy,oz,dx,dy,dz,tmin,tmax\n"), SceneError);
}

TEST_CASE("a file of rays that cannot be opened is a file fault")
{
    CHECK_THROWS_WITH_AS(read_rays("no/such/rays.csv"), doctest::Contains("No such file"), FileError);
    CHECK_THROWS_WITH_AS(read_rays("."), doctest::Contains("it is a folder"), FileError);
}

TEST_CASE("answers read back to the same bits, and a miss is infinitely far")
{
    Scene scene;
    scene.groups.resize(2);
    scene.parts.resize(1);
    scene.parts[0].group = 1;
    scene.part_of_primitive = {0, 0, 0};
    CHECK(format_answer<float>(scene, {0.1f, 0.25f, 1.0f / 3.0f, 2}) == "0.1,1,2,0.25,0.33333334\n");
    CHECK(format_answer<double>(scene, {0.1, 0.25, 1.0 / 3.0, 2}) == "0.1,1,2,0.25,0.3333333333333333\n");
    CHECK(format_answer<float>(scene, {1e30f, 0, 0, no_primitive}) == "inf,-1,-1,0,0\n");
    for (const double t : {1.0000000000000002, 123456789.123456789, 1e22}) {
        const std::string text = format_answer<double>(scene, {t, 0, 0, 0});
        CHECK(std::stod(text) == t);
    }
}

}  // namespace
}  // namespace firstray::command
