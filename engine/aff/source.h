#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>

#include "engine/aff/reader.h"

namespace firstray::inline v0 {

class Lexer;

/// A file's whole text.
struct SourceFile {
    std::string shown;                ///< the path as it was opened, for messages
    std::filesystem::path canonical;  ///< tells whether two names mean one file
    std::string text;
    std::uint64_t digest = 0;  ///< of the text
};

/// What a message about a file says before and after, when a scene file names that file.
struct Mention {
    std::string place;  ///< "file:line:column: ", or empty
    std::string chain;  ///< "\n  included from ..." lines, or empty
};

/// Finds the files of a scene, which all lie in (or below) the main file's folder, and reads each of them once.
class SceneFolder {
public:
    /// throws  FileError when the main file cannot be read, LimitError when it is too large
    SceneFolder(const std::filesystem::path& main_file, const ReadLimits& limits);

    const SourceFile& main() const { return *main_; }
    /// The file that a name in a scene file means. References live as long as the folder.
    /// in      where the name was read: faults are reported there
    /// throws  FileError, SceneError when it lies outside the folder, LimitError
    const SourceFile& open(const std::string& name, const Lexer& in);
    /// Throws what `open` would throw if the file cannot be used; does not read it.
    void check(const std::string& name, const Lexer& in) const;

    std::uint64_t files() const { return by_path_.size(); }  ///< distinct ones read
    std::uint64_t bytes() const { return bytes_; }           ///< of those

private:
    std::filesystem::path find(const std::string& name, const Lexer& in) const;
    const SourceFile& read(const std::filesystem::path& shown, const std::filesystem::path& canonical,
                           const Mention& mention);

    ReadLimits limits_;
    std::filesystem::path folder_, canonical_folder_;
    std::unordered_map<std::string, std::unique_ptr<SourceFile>> by_path_;  // canonical
    std::unordered_map<std::string, const SourceFile*> by_name_;            // as written in an include
    const SourceFile* main_ = nullptr;
    std::uint64_t bytes_ = 0;
};

}  // namespace firstray::inline v0
