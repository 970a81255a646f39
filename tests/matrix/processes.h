#pragma once
#include <sys/wait.h>
#include <cstdint>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>

namespace firstray::matrix {

/// How another program ended, and what it said.
struct Ended {
    int code = -1;
    std::string out;
};

/// Runs a shell's command line; its standard error is dropped.
inline Ended run_program(const std::string& line)
{
    Ended ended;
    FILE* const pipe = popen((line + " 2>/dev/null").c_str(), "r");
    if (!pipe) return ended;
    char buffer[4096];
    for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) ended.out.append(buffer, n);
    const int status = pclose(pipe);
    ended.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
    return ended;
}

}  // namespace firstray::matrix
