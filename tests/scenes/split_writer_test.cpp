#include "scenes/generator/split_writer.h"

#include <doctest/doctest.h>

#include "engine/aff/reader.h"
#include "tests/support/temp_folder.h"

using namespace firstray;
using namespace firstray::scenes;

TEST_CASE("a large part goes into several files, all of which the scene includes")
{
    const test::TempFolder folder;
    const Request request{folder.path() / "s.aff"};
    AffWriter main(request.file);
    SplitWriter files(request, "part", main, 100'000);
    Mesh mesh;
    for (int i = 0; i < 30; ++i) add_box(mesh, glm::dvec3(i + 0.123456), glm::dvec3(i + 0.654321));
    for (int i = 0; i < 200; ++i) files.out().mesh(mesh);
    CHECK(files.triangles() == 200 * mesh.triangles.size());
    files.finish();
    CHECK(main.triangles() == 200 * mesh.triangles.size());
    main.finish();
    const Scene scene = read_aff(request.file);
    CHECK(scene.triangles.size() == 200 * mesh.triangles.size());
    CHECK(scene.census.files > 10);
    for (const auto& file : std::filesystem::directory_iterator(folder.path())) CHECK(file.file_size() < 300'000);
}

TEST_CASE("a part that nothing was written of makes no file")
{
    const test::TempFolder folder;
    const Request request{folder.path() / "s.aff"};
    AffWriter main(request.file);
    SplitWriter files(request, "part", main);
    files.finish();
    main.finish();
    CHECK(!std::filesystem::exists(request.beside("part_0.aff")));
    CHECK(read_aff(request.file).census.files == 1);
}
