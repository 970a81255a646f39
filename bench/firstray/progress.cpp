#include "bench/firstray/progress.h"

#include <fmt/format.h>

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

void Progress::frame_done(int frame)
{
    ++done_;
    if (style_ == ProgressStyle::never) return;
    const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start_;
    const double left = elapsed.count() / static_cast<double>(done_) * static_cast<double>(frames_ - done_);
    const std::string text = fmt::format("frame {} ({}/{}), {} %, {} left", frame, done_, frames_,
                                         100 * done_ / frames_, format_duration(left));
    if (style_ == ProgressStyle::lines) return message(text);
    err_ << "\r\x1b[K" << text << std::flush;
    line_open_ = true;
}

std::string format_duration(double seconds)
{
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole >= 3600) return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
    return fmt::format("{}:{:02}", whole / 60, whole % 60);
}

}  // namespace firstray::command
