#include "scenes/generator/aff_writer.h"

#include <fmt/format.h>

#include "engine/core/errors.h"

namespace firstray::scenes {

struct AffWriter::Buffer {
    fmt::memory_buffer text;
};

namespace {

constexpr std::size_t buffer_bytes = 1u << 16;

/// Coordinates are written as floats: what readers hold them in, and short.
float number(double value)
{
    return static_cast<float>(value) + 0.0f;  // no "-0"
}

}  // namespace

AffWriter::AffWriter(const std::filesystem::path& file)
    : target_(file), out_(target_.path(), std::ios::binary), buffer_(std::make_unique<Buffer>())
{
    if (!out_) throw FileError("cannot write " + file.string());
}

AffWriter::~AffWriter() = default;

template <typename... Values>
void AffWriter::put(std::string_view format, const Values&... values)
{
    fmt::format_to(std::back_inserter(buffer_->text), fmt::runtime(format), values...);
    if (buffer_->text.size() > buffer_bytes) flush();
}

void AffWriter::put_point(const glm::dvec3& p)
{
    put("{} {} {}\n", number(p.x), number(p.y), number(p.z));
}

void AffWriter::flush()
{
    bytes_ += buffer_->text.size();
    out_.write(buffer_->text.data(), static_cast<std::streamsize>(buffer_->text.size()));
    buffer_->text.clear();
    if (!out_) throw FileError("cannot write " + target_.path().string() + ": the disk may be full");
}

void AffWriter::finish()
{
    flush();
    out_.close();
    if (!out_) throw FileError("cannot write " + target_.path().string() + ": the disk may be full");
    target_.commit();
}

void AffWriter::comment(std::string_view text)
{
    put("# {}\n", text);
}

void AffWriter::view(const View& view)
{
    put("v\nfrom ");
    put_point(view.from);
    put("at ");
    put_point(view.at);
    put("up ");
    put_point(view.up);
    put("angle {}\nhither {}\nresolution {} {}\n", number(view.angle), number(view.hither), view.width, view.height);
}

void AffWriter::frames(double start, double end, int count)
{
    put("a {} {} {}\n", number(start), number(end), count);
}

void AffWriter::background(const glm::vec3& colour)
{
    put("b ");
    put_point(colour);
}

void AffWriter::ambient(const glm::vec3& colour)
{
    put("am ");
    put_point(colour);
}

void AffWriter::light(const glm::dvec3& position, const glm::vec3& colour, std::string_view name)
{
    put("{} ", name.empty() ? std::string("l") : "la " + std::string(name));
    put_point(position);
    put_point(colour);
}

void AffWriter::material(const Material& m)
{
    if (material_ == m) return;
    material_ = m;
    put("fm  {} {} {}  {} {} {}  {} {} {}  {} {} {}\n", m.ambient.x, m.ambient.y, m.ambient.z, m.diffuse.x, m.diffuse.y,
        m.diffuse.z, m.specular.x, m.specular.y, m.specular.z, m.shine, m.transmittance, m.ior);
}

void AffWriter::mesh(const Mesh& mesh, std::string_view texture)
{
    put("m\nvertices {}\n", mesh.positions.size());
    for (const glm::dvec3& p : mesh.positions) put_point(p);
    if (!mesh.normals.empty()) put("normals {}\n", mesh.normals.size());
    for (const glm::dvec3& n : mesh.normals) put_point(n);
    const bool textured = !mesh.uvs.empty() && !texture.empty();
    if (textured) {
        put("texturecoords {} {}\n", mesh.uvs.size(), texture);
        for (const glm::dvec2& uv : mesh.uvs) put("{} {}\n", number(uv.x), number(uv.y));
    }
    put("triangles {}\n", mesh.triangles.size());
    for (const Mesh::Triangle& t : mesh.triangles) {
        put("{} {} {}", t.vertex.x, t.vertex.y, t.vertex.z);
        if (!mesh.normals.empty()) put(" {} {} {}", t.normal.x, t.normal.y, t.normal.z);
        if (textured) put(" {} {} {}", t.uv.x, t.uv.y, t.uv.z);
        put("\n");
    }
    triangles_ += mesh.triangles.size();
}

void AffWriter::sphere(const glm::dvec3& centre, double radius)
{
    put("s {} {} {} {}\n", number(centre.x), number(centre.y), number(centre.z), number(radius));
}

void AffWriter::cone(const glm::dvec3& base, double base_radius, const glm::dvec3& apex, double apex_radius)
{
    put("c {} {} {} {}  ", number(base.x), number(base.y), number(base.z), number(base_radius));
    put("{} {} {} {}\n", number(apex.x), number(apex.y), number(apex.z), number(apex_radius));
}

void AffWriter::deforming_triangle(std::span<const DeformingKey> keys, std::span<const DeformingNormals> normals)
{
    put("tpa {}\n", keys.size());
    for (std::size_t at = 0; at < keys.size(); ++at) {
        put("{}\n", number(keys[at].time));
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3& p = keys[at].position[i];
            const glm::vec3& n = normals[at].corner[i];
            put("{} {} {} {} {} {}\n", number(p.x), number(p.y), number(p.z), number(n.x), number(n.y), number(n.z));
        }
    }
    ++triangles_;
}

void AffWriter::open(const Placement& p)
{
    put("xs {} {} {}  ", number(p.scale.x), number(p.scale.y), number(p.scale.z));
    put("{} {} {} {}  ", number(p.axis.x), number(p.axis.y), number(p.axis.z), number(p.degrees));
    put("{} {} {}\n{{\n", number(p.offset.x), number(p.offset.y), number(p.offset.z));
}

void AffWriter::open(std::string_view name)
{
    put("x {}\n{{\n", name);
}

void AffWriter::close()
{
    put("}}\n");
}

void AffWriter::put_keys(std::string_view track, const std::vector<Key>& keys, bool with_angle)
{
    if (keys.empty()) return;
    put("{} {}\n", track, keys.size());
    for (const Key& k : keys) {
        put("{} {} {} {}", number(k.time), number(k.value.x), number(k.value.y), number(k.value.z));
        if (with_angle) put(" {}", number(k.angle));
        put(" {} {} {}\n", number(k.tension), number(k.continuity), number(k.bias));
    }
}

void AffWriter::keys(const Animation& animation)
{
    put("k {}\n{{\n", animation.name);
    put_keys("transl", animation.translation.keys(), false);
    put_keys("rot", animation.rotation.keys(), true);
    put_keys("scale", animation.scale.keys(), false);
    if (!animation.visibility.empty()) put("visibility {}\n", animation.visibility.size());
    for (const VisibilityKey& key : animation.visibility) put("{} {}\n", number(key.time), key.visible ? 1 : 0);
    put("}}\n");
}

void AffWriter::include(std::string_view name, std::uint64_t triangles)
{
    put("i 0 {}\n", name);
    triangles_ += triangles;
}

}  // namespace firstray::scenes
