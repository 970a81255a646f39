#include "engine/aff/source.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "engine/aff/lexer.h"
#include "engine/core/fnv.h"

namespace firstray::inline v0 {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void cannot(const char* act, const fs::path& path, const std::string& reason, const Mention& mention)
{
    throw FileError(mention.place + "cannot " + act + " " + printable(path.string()) + ": " + reason + mention.chain);
}

/// The path without links and dots, of a regular file: a name must not open a device or wait at a pipe.
fs::path canonical_file(const fs::path& path, const Mention& mention)
{
    std::error_code error;
    fs::path canonical = fs::canonical(path, error);
    if (error) cannot("open", path, error.message(), mention);
    if (!fs::is_regular_file(canonical, error)) cannot("open", path, "not a regular file", mention);
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
    const fs::path canonical = canonical_file(main_file, {});
    canonical_folder_ = fs::canonical(folder_.empty() ? fs::path(".") : folder_);
    main_ = &read(main_file, canonical, {});
}

fs::path SceneFolder::find(const std::string& name, const Lexer& in) const
{
    const fs::path canonical = canonical_file(folder_ / name, in.mention());
    if (!limits_.allow_outside && !lies_in(canonical_folder_, canonical))
        in.fault(quote(name) + " lies outside the scene's folder", "a file inside it");
    return canonical;
}

const SourceFile& SceneFolder::open(const std::string& name, const Lexer& in)
{
    if (const auto known = by_name_.find(name); known != by_name_.end()) return *known->second;
    const fs::path canonical = find(name, in);
    return *(by_name_[name] = &read(folder_ / name, canonical, in.mention()));
}

void SceneFolder::check(const std::string& name, const Lexer& in) const
{
    find(name, in);
}

const SourceFile& SceneFolder::read(const fs::path& shown, const fs::path& canonical, const Mention& mention)
{
    if (const auto known = by_path_.find(canonical.string()); known != by_path_.end()) return *known->second;
    if (by_path_.size() >= limits_.files)
        throw LimitError(mention.place + "more than " + std::to_string(limits_.files) + " distinct files", "files",
                         mention.chain);
    std::ifstream file(canonical, std::ios::binary | std::ios::ate);
    const std::streamoff size = file ? static_cast<std::streamoff>(file.tellg()) : -1;
    if (size < 0) cannot("open", shown, std::strerror(errno), mention);
    if (static_cast<std::uint64_t>(size) > limits_.file_bytes)
        throw LimitError(mention.place + printable(shown.string()) + " has " + std::to_string(size) +
                             " bytes, more than " + std::to_string(limits_.file_bytes),
                         "file_bytes", mention.chain);
    auto source = std::make_unique<SourceFile>(SourceFile{printable(shown.string()), canonical, {}, 0});
    source->text.resize(static_cast<std::size_t>(size));
    file.seekg(0).read(source->text.data(), size);
    if (!file) cannot("read", shown, std::strerror(errno), mention);
    source->digest = fnv_mixed(fnv_offset_basis, source->text);
    bytes_ += source->text.size();
    return *(by_path_[canonical.string()] = std::move(source));
}

}  // namespace firstray::inline v0
