#pragma once
#include <optional>
#include <string>

#include "scenes/generator/aff_writer.h"
#include "scenes/generator/generate.h"

namespace firstray::scenes {

/// Writes a large part of a scene into as many files as it takes, "SCENE_part_0.aff" and so on, each of which the main
/// file includes: readers hold a file at a time.
class SplitWriter {
public:
    /// part  begins the files' names; request and main must outlive the writer
    /// full  bytes of a file after which no more is begun in it
    SplitWriter(const Request& request, std::string part, AffWriter& main, std::uint64_t full = 200u << 20);

    /// Where to write what belongs together, with no transform open: the next file where this one is full.
    AffWriter& out();
    /// In the whole scene up to now.
    std::uint64_t triangles() const { return main_.triangles() + (file_ ? file_->triangles() : 0); }
    void finish();

private:
    const Request& request_;
    AffWriter& main_;
    std::string part_, name_;
    std::uint64_t full_;
    std::optional<AffWriter> file_;
    int files_ = 0;
};

}  // namespace firstray::scenes
