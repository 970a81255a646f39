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

/// "3/10, 30 %, 0:12 left".
std::string Progress::standing() const
{
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const std::size_t all = std::max(frames_, done_);
    if (done_ == 0) return fmt::format("0/{}", all);
    const double left = elapsed.count() / static_cast<double>(done_) * static_cast<double>(all - done_);
    return fmt::format("{}/{}, {} %, {} left", done_, all, 100 * done_ / all, format_duration(left));
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

void Progress::step(const std::string& what)
{
    constexpr std::chrono::seconds between_lines(10);
    if (in_step_) ++done_;
    in_step_ = true;
    if (style_ == ProgressStyle::never) return;
    const std::string text = fmt::format("{} ({})", what, standing());
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
