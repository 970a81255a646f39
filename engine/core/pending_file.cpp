#include "engine/core/pending_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "engine/core/errors.h"

namespace firstray::inline v0 {
namespace {

/// A name next to `target` that neither another process nor another thread picks at the same time:
/// ".target.process-number.part".
std::filesystem::path temporary_name(const std::filesystem::path& target)
{
    static std::atomic<unsigned> counter{0};
    const std::string unique = std::to_string(getpid()) + "-" + std::to_string(counter++);
    return target.parent_path() / ("." + target.filename().string() + "." + unique + ".part");
}

/// Whose temporary file has that name, and what it was to become.
struct Owner {
    pid_t process = 0;  ///< 0: it is no such name
    std::string target;
};

Owner owner_of(std::string_view name)
{
    constexpr std::string_view ending = ".part";
    if (!name.starts_with('.')) return {};
    name.remove_prefix(1);
    if (!name.ends_with(ending)) return {};
    name.remove_suffix(ending.size());
    const std::size_t dot = name.rfind('.');
    if (dot == std::string_view::npos || dot == 0 || name.substr(dot + 1).starts_with('0')) return {};

    const char* const end = name.data() + name.size();
    pid_t process = 0;
    unsigned counter = 0;
    const auto process_read = std::from_chars(name.data() + dot + 1, end, process);
    if (process_read.ec != std::errc{} || process < 0 || process_read.ptr == end || *process_read.ptr != '-') return {};
    const auto counter_read = std::from_chars(process_read.ptr + 1, end, counter);
    if (counter_read.ec != std::errc{} || counter_read.ptr != end) return {};
    return {process, std::string(name.substr(0, dot))};
}

bool is_gone(pid_t process)
{
    return kill(process, 0) != 0 && errno == ESRCH;
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
    const std::filesystem::file_status there = std::filesystem::status(target_, error);
    if (std::filesystem::is_directory(there)) cannot_write(target_, "a folder has that name");
    // A rename would put a file in the place of the device.
    if (std::filesystem::exists(there) && !std::filesystem::is_regular_file(there))
        cannot_write(target_, "it is there and is not a regular file");
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

void remove_abandoned(std::span<const std::filesystem::path> targets)
{
    std::map<std::filesystem::path, std::set<std::string>> names_by_folder;
    for (const std::filesystem::path& target : targets)
        names_by_folder[target.has_parent_path() ? target.parent_path() : "."].insert(target.filename().string());
    for (const auto& [folder, names] : names_by_folder) {
        std::error_code error;  // a folder that is not there holds nothing
        for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
            const Owner owner = owner_of(at->path().filename().string());
            std::error_code ignored;
            if (owner.process != 0 && names.contains(owner.target) && is_gone(owner.process))
                std::filesystem::remove(at->path(), ignored);
        }
    }
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
