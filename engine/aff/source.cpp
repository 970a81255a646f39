#include "engine/aff/source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/aff/lexer.h"

namespace firstray {
namespace {

namespace fs = std::filesystem;

/// The path without links and dots, of a regular file: a name must not open a device or wait at a pipe.
/// place  "file:line:column: " of the name, or empty
fs::path canonical_file(const fs::path& path, const std::string& place)
{
    std::error_code error;
    fs::path canonical = fs::canonical(path, error);
    if (error) throw FileError(place + "cannot open " + path.string() + ": " + error.message());
    if (!fs::is_regular_file(canonical, error))
        throw FileError(place + "cannot open " + path.string() + ": not a regular file");
    return canonical;
}

bool lies_in(const fs::path& folder, const fs::path& file)
{
    return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

}  // namespace

SceneFolder::SceneFolder(const fs::path& main_file, const ReadLimits& limits)
    : limits_(limits), folder_(main_file.parent_path())
{
    const fs::path canonical = canonical_file(main_file, "");
    canonical_folder_ = fs::canonical(folder_.empty() ? fs::path(".") : folder_);
    main_ = &read(main_file, canonical, "");
}

fs::path SceneFolder::find(const std::string& name, const Lexer& in) const
{
    const fs::path canonical = canonical_file(folder_ / name, in.place_prefix());
    if (!limits_.allow_outside && !lies_in(canonical_folder_, canonical))
        in.fault(quote(name) + " lies outside the scene's folder", "a file inside it");
    return canonical;
}

const SourceFile& SceneFolder::open(const std::string& name, const Lexer& in)
{
    if (const auto known = by_name_.find(name); known != by_name_.end()) return *known->second;
    const fs::path canonical = find(name, in);
    return *(by_name_[name] = &read(folder_ / name, canonical, in.place_prefix()));
}

void SceneFolder::check(const std::string& name, const Lexer& in) const
{
    find(name, in);
}

const SourceFile& SceneFolder::read(const fs::path& shown, const fs::path& canonical, const std::string& place)
{
    if (const auto known = by_path_.find(canonical.string()); known != by_path_.end()) return *known->second;
    if (by_path_.size() >= limits_.files)
        throw LimitError(place + "more than " + std::to_string(limits_.files) + " distinct files (limit: files)");
    std::ifstream file(canonical, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0) throw FileError(place + "cannot open " + shown.string() + ": " + std::strerror(errno));
    if (static_cast<std::uint64_t>(size) > limits_.file_bytes)
        throw LimitError(place + shown.string() + " has " + std::to_string(size) + " bytes, more than " +
                         std::to_string(limits_.file_bytes) + " (limit: file_bytes)");
    auto source = std::make_unique<SourceFile>(SourceFile{shown.string(), canonical, {}});
    source->text.resize(static_cast<std::size_t>(size));
    file.seekg(0).read(source->text.data(), size);
    if (!file) throw FileError(place + "cannot read " + shown.string() + ": " + std::strerror(errno));
    bytes_ += source->text.size();
    return *(by_path_[canonical.string()] = std::move(source));
}

}  // namespace firstray
