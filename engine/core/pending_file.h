#pragma once
#include <filesystem>
#include <span>
#include <string_view>

namespace firstray::inline v0 {

/// A file on its way: written under a temporary name in the folder of its target and renamed when it is whole, so that
/// a reader sees the old file or the new one, never a part. The temporary file goes away if commit() was not reached.
class PendingFile {
public:
    /// Makes the target's folders where they are missing.
    /// throws  FileError when that fails, or where the target is there and is no file: a folder, a device, a pipe
    explicit PendingFile(std::filesystem::path target);
    ~PendingFile();
    PendingFile(const PendingFile&) = delete;
    PendingFile& operator=(const PendingFile&) = delete;

    /// Where to write; no file of that name exists yet.
    const std::filesystem::path& path() const { return temporary_; }

    /// Moves the written file to its target.
    /// throws  FileError
    void commit();

private:
    std::filesystem::path target_, temporary_;
};

/// Removes the temporary files of these targets that were left by processes of this machine which live no more.
void remove_abandoned(std::span<const std::filesystem::path> targets);

/// Writes `content` to `file`, complete or not at all.
/// throws  FileError
void write_whole_file(const std::filesystem::path& file, std::string_view content);

}  // namespace firstray::inline v0
