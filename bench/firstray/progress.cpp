#include "bench/firstray/progress.h"

#include <fmt/format.h>

#include <algorithm>

#include "bench/firstray/words.h"

namespace firstray::command {

ProgressStyle progress_style(std::string_view mode, bool terminal)
{
    constexpr std::string_view modes[] = {"auto", "always", "never"};
    if (find_word("--progress", mode, modes) == 2) return ProgressStyle::never;
    return terminal ? ProgressStyle::rewritten : ProgressStyle::lines;
}

Progress::Progress(std::ostream& err, ProgressStyle style, std::size_t frames)
    : err_(err), style_(style), frames_(frames)
{
}

Progress::~Progress()
{
    clear();
}

void Progress::clear()
{
    if (line_open_) err_ << "\r\x1b[K" << std::flush;  // ANSI: erase to the end of the line
    line_open_ = false;
}

void Progress::message(std::string_view text)
{
    clear();
    err_ << "firstray: " << text << std::endl;
}

/// "30 %, 0:12 left"; early on the share alone.
std::string Progress::outlook(double share) const
{
    constexpr double early = 0.05;  // the first steps take longer or less than they seem to
    if (share < early) return fmt::format("{} %", static_cast<int>(100.0 * share));
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    return fmt::format("{} %, {} left", static_cast<int>(100.0 * share),
                       format_duration(elapsed.count() * (1.0 / share - 1.0)));
}

/// "3/10, 30 %, 0:12 left".
std::string Progress::standing() const
{
    const std::size_t all = std::max(frames_, done_);
    if (done_ == 0) return fmt::format("0/{}", all);
    return fmt::format("{}/{}, {}", done_, all, outlook(static_cast<double>(done_) / static_cast<double>(all)));
}

void Progress::frame_done(int frame)
{
    ++done_;
    if (style_ == ProgressStyle::never) return;
    const std::string text = fmt::format("frame {} ({})", frame, standing());
    if (style_ == ProgressStyle::lines) return message(text);
    err_ << "\r\x1b[K" << text << std::flush;
    line_open_ = true;
}

void Progress::step(const std::string& what, double work)
{
    constexpr std::chrono::seconds between_lines(10);
    const double done = begun_;
    begun_ += work;
    if (style_ == ProgressStyle::never) return;
    const std::string text =
        done == 0.0 ? what : fmt::format("{} ({})", what, outlook(std::min(1.0, done / std::max(work_, begun_))));
    if (style_ == ProgressStyle::rewritten) {
        err_ << "\r\x1b[K" << text << std::flush;
        line_open_ = true;
        return;
    }
    const auto now = std::chrono::steady_clock::now();
    if (now - last_line_ < between_lines) return;
    last_line_ = now;
    message(text);
}

std::string format_duration(double seconds)
{
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace firstray::command
