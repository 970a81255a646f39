#include "engine/core/pending_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
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

Owner owner_of(const std::string& name)
{
    static const std::regex pattern(R"(\.(.+)\.([1-9][0-9]{0,8})-[0-9]+\.part)");
    std::smatch parts;
    if (!std::regex_match(name, parts, pattern)) return {};
    return {static_cast<pid_t>(std::stol(parts[2])), parts[1]};
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
