#pragma once
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "engine/core/pending_file.h"
#include "engine/scene/scene.h"
#include "scenes/generator/mesh.h"

namespace firstray::scenes {

/// Where `xs` puts things: scaled, then turned about an axis, then moved.
struct Placement {
    glm::dvec3 scale{1.0}, axis{0.0, 1.0, 0.0};
    double degrees = 0.0;
    glm::dvec3 offset{0.0};
};

/// Writes one AFF file as a stream: nothing but a small buffer is held. Numbers are written as the shortest decimal
/// that reads back as the same float, whatever the locale. The file appears when finish() is called. Writing functions
/// throw FileError when the disk does not take it.
class AffWriter {
public:
    explicit AffWriter(const std::filesystem::path& file);
    ~AffWriter();

    void comment(std::string_view text);
    void view(const View& view);
    void frames(double start, double end, int count);
    void background(const glm::vec3& colour);
    void ambient(const glm::vec3& colour);
    /// name  of the track that moves the light, or empty
    void light(const glm::dvec3& position, const glm::vec3& colour, std::string_view name = {});
    /// What follows is made of this. Written only when it changes.
    void material(const Material& material);
    /// To be called where another file may have set the material.
    void forget_material() { material_.reset(); }

    /// texture  file name; used if the mesh has texture coordinates
    void mesh(const Mesh& mesh, std::string_view texture = {});
    void sphere(const glm::dvec3& centre, double radius);
    void cone(const glm::dvec3& base, double base_radius, const glm::dvec3& apex, double apex_radius);
    /// normals  by key
    void deforming_triangle(std::span<const DeformingKey> keys, std::span<const DeformingNormals> normals);

    void open(const Placement& placement);  ///< `xs`
    void open(std::string_view name);       ///< `x`: moved by keys() of that name
    void close();
    void keys(const Animation& animation);

    /// triangles  that the file holds
    void include(std::string_view name, std::uint64_t triangles);

    std::uint64_t triangles() const { return triangles_; }  ///< written up to now, included ones too
    std::uint64_t bytes() const { return bytes_; }          ///< likewise, of this file

    /// Puts the file in its place, whole. Nothing may be written afterwards.
    void finish();

private:
    template <typename... Values>
    void put(std::string_view format, const Values&... values);
    void put_point(const glm::dvec3& point);
    void put_keys(std::string_view track, const std::vector<Key>& keys, bool with_angle);
    void flush();

    struct Buffer;
    PendingFile target_;
    std::ofstream out_;
    std::unique_ptr<Buffer> buffer_;
    std::optional<Material> material_;
    std::uint64_t triangles_ = 0, bytes_ = 0;
};

}  // namespace firstray::scenes
