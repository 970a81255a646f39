#include "engine/aff/reader.h"

#include <deque>

#include "engine/aff/statements.h"
#include "engine/core/fnv.h"

namespace firstray::inline v0 {
namespace {

struct Statement {
    std::string_view letters;
    void (*read)(Reading&);
};

constexpr Statement statements[] = {
    {"v", read_view},
    {"b", read_background},
    {"am", read_ambient},
    {"a", read_times},
    {"l", read_light},
    {"la", read_named_light},
    {"f", read_nff_material},
    {"fm", read_material},
    {"k", read_keyframes},
    {"c", read_cone},
    {"s", read_sphere},
    {"p", read_polygon},
    {"pp", read_polygon_with_normals},
    {"tt", read_textured_triangle},
    {"ttp", read_textured_triangle_with_normals},
    {"tpa", read_deforming_triangle},
    {"m", read_mesh},
};

/// Reads a main file and all it includes, statement by statement. Keeps the open files and transforms on stacks of its
/// own: no nesting in a file can exhaust the program's.
class Reader {
public:
    Reader(const std::filesystem::path& main_file, const ReadLimits& limits)
        : limits_(limits), folder_(main_file, limits), builder_(limits)
    {
        open(folder_.main());
    }

    Scene read()
    {
        while (!files_.empty()) read_statement();
        Scene scene = builder_.finish();
        scene.census.files = folder_.files();
        scene.census.bytes = folder_.bytes();
        scene.census.digest = digest_;
        return scene;
    }

private:
    struct OpenFile {
        Lexer in;
        std::size_t depth;  // transforms open where it is included: it must leave as many open
    };

    Lexer& in() { return files_.back().in; }

    void open(const SourceFile& file)
    {
        digest_ = fnv_mixed(digest_, file.digest);
        files_.push_back({Lexer(file, files_.empty() ? nullptr : &files_.back().in), builder_.depth()});
    }

    void read_statement()
    {
        const std::string_view letters = in().statement();
        if (letters.empty()) return end_file();
        if (letters == "}") return close_transform();
        if (!read_structure(letters) && !read_content(letters)) in().fault("a statement");
    }

    bool read_content(std::string_view letters)
    {
        for (const Statement& statement : statements) {
            if (statement.letters != letters) continue;
            builder_.count(letters);
            Reading reading{in(), builder_, folder_, limits_};
            statement.read(reading);
            return true;
        }
        return false;
    }

    /// Statements that change what is read and where it stands.
    bool read_structure(std::string_view letters)
    {
        if (letters == "i") {
            read_include();
        } else if (letters == "d") {
            builder_.count(letters);
            detail_level_ = read_level();
        } else if (letters == "xs") {
            builder_.count(letters);
            builder_.open_static(read_transform(in()), in());
            in().keyword("{");
        } else if (letters == "x") {
            builder_.count(letters);
            builder_.open_dynamic(in().word("the transform's name"), in());
            in().keyword("{");
        } else {
            return false;
        }
        return true;
    }

    std::int64_t read_level() { return in().integer(-1'000'000, 1'000'000, "a level of detail"); }

    void read_include()
    {
        const std::int64_t level = read_level();
        const std::string name = in().word("a file name");
        if (level > detail_level_) return builder_.count("i (too detailed, skipped)");
        builder_.count("i");
        const SourceFile& file = folder_.open(name, in());
        for (const OpenFile& outer : files_)
            if (&outer.in.file() == &file) in().fault(quote(name) + " includes itself", "includes without a circle");
        if (files_.size() > limits_.include_depth)
            in().over_limit("includes inside each other", limits_.include_depth, "include_depth");
        expanded_bytes_ += file.text.size();
        if (expanded_bytes_ > limits_.expanded_bytes)
            in().over_limit("bytes with every repetition of a file", limits_.expanded_bytes, "expanded_bytes");
        open(file);
    }

    void close_transform()
    {
        if (builder_.depth() == files_.back().depth) in().fault("a statement (no transform is open in this file)");
        builder_.close();
    }

    void end_file()
    {
        if (builder_.depth() != files_.back().depth)
            in().fault("\"}\" (" + std::to_string(builder_.depth() - files_.back().depth) + " open)");
        files_.pop_back();
    }

    const ReadLimits& limits_;
    SceneFolder folder_;
    SceneBuilder builder_;
    std::deque<OpenFile> files_;  // stable addresses: a lexer points to the one that includes it
    std::int64_t detail_level_ = 0;
    std::uint64_t expanded_bytes_ = 0;
    std::uint64_t digest_ = fnv_offset_basis;
};

}  // namespace

Scene read_aff(const std::filesystem::path& main_file, const ReadLimits& limits)
{
    Scene scene = Reader(main_file, limits).read();
    scene.name = main_file.stem().string();
    scene.folder = main_file.has_parent_path() ? main_file.parent_path().string() : ".";
    return scene;
}

}  // namespace firstray::inline v0
