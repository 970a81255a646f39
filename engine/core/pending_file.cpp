#include "engine/core/pending_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <string>
#include <system_error>

#include "engine/core/errors.h"

namespace firstray::inline v0 {
namespace {

/// A name next to `target` that neither another process nor another thread picks at the same time.
std::filesystem::path temporary_name(const std::filesystem::path& target)
{
    static std::atomic<unsigned> counter{0};
    const std::string unique = std::to_string(getpid()) + "-" + std::to_string(counter++);
    return target.parent_path() / ("." + target.filename().string() + "." + unique + ".part");
}

[[noreturn]] void cannot_write(const std::filesystem::path& file, const std::string& reason)
{
    throw FileError("cannot write " + file.string() + ": " + reason);
}

}  // namespace

PendingFile::PendingFile(std::filesystem::path target) : target_(std::move(target)), temporary_(temporary_name(target_))
{
    std::error_code error;
    if (!target_.parent_path().empty()) std::filesystem::create_directories(target_.parent_path(), error);
    if (error) cannot_write(target_, "cannot make its folder: " + error.message());
    if (std::filesystem::is_directory(target_, error)) cannot_write(target_, "a folder has that name");
}

PendingFile::~PendingFile()
{
    std::error_code ignored;  // nothing there is the usual case
    if (!temporary_.empty()) std::filesystem::remove(temporary_, ignored);
}

void PendingFile::commit()
{
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) cannot_write(target_, error.message());
    temporary_.clear();
}

void write_whole_file(const std::filesystem::path& file, std::string_view content)
{
    PendingFile pending(file);
    errno = 0;
    std::ofstream out(pending.path(), std::ios::binary);
    out.write(content.data(), static_cast<std::streamsize>(content.size()));
    out.close();
    if (!out) cannot_write(file, std::generic_category().message(errno != 0 ? errno : EIO));
    pending.commit();
}

}  // namespace firstray::inline v0
