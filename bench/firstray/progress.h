#pragma once
#include <chrono>
#include <ostream>
#include <string>
#include <string_view>

namespace firstray::command {

enum class ProgressStyle {
    never,
    lines,     ///< a line per frame
    rewritten  ///< one line that is written over, for terminals
};

/// `mode` is auto, always or never.
/// throws  UsageError
ProgressStyle progress_style(std::string_view mode, bool terminal);

/// Tells how far a render has come.
class Progress {
public:
    Progress(std::ostream& err, ProgressStyle style, std::size_t frames);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void frame_done(int frame);

    /// Instead of frames: what all steps come to, in any unit.
    void expect(double work) { work_ = work; }
    /// A step of so much work begins, which ends the one before it. Beside a terminal, a line about every ten seconds.
    void step(const std::string& what, double work);

    /// Writes a line that stays.
    void message(std::string_view text);

private:
    void clear();
    std::string standing() const;
    /// Share done, and time left.
    std::string outlook(double share) const;

    std::ostream& err_;
    ProgressStyle style_;
    std::size_t frames_, done_ = 0;
    double work_ = 0.0, begun_ = 0.0;  // of all steps, and of those that began
    bool line_open_ = false;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now(), last_line_{};
};

/// "h:mm:ss", or "m:ss" below an hour.
std::string format_duration(double seconds);

}  // namespace firstray::command
