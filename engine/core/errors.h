#pragma once
#include <stdexcept>
#include <string>

namespace firstray::inline v0 {

/// What a failed run is to blame on; the command's exit codes are these values.
enum class Fault { rendering = 1, usage = 2, scene = 3, file = 4, limit = 5 };

/// Base of everything the library throws on purpose. what() is one line (a scene fault adds one line per include).
class Error : public std::runtime_error {
public:
    Error(Fault fault, const std::string& message) : std::runtime_error(message), fault_(fault) {}  ///< with what()
    Fault fault() const { return fault_; }                                                          ///< what to blame

private:
    Fault fault_;
};

/// A place in a scene file; lines and columns count from 1, columns in bytes.
struct FilePlace {
    std::string file;  ///< as it was opened
    int line = 1;      ///< from 1
    int column = 1;    ///< from 1
};

/// A file that does not say what it must: "file:line:column: what was read, expected what was expected".
class SceneError : public Error {
public:
    /// includes  the chain of includes that led there, one line each ("\n  included from main.aff:12:3"), or empty
    SceneError(const FilePlace& place, const std::string& read, const std::string& expected,
               const std::string& includes = {})
        : Error(Fault::scene, place.file + ":" + std::to_string(place.line) + ":" + std::to_string(place.column) +
                                  ": " + read + ", expected " + expected + includes)
    {
    }
};

/// A file that cannot be opened, read or written; the message names it and the reason.
class FileError : public Error {
public:
    explicit FileError(const std::string& message) : Error(Fault::file, message) {}  ///< with what()
};

/// Rendering that was told to stop.
class Cancelled : public Error {
public:
    Cancelled() : Error(Fault::rendering, "cancelled") {}
};

/// Something larger than a limit allows; the message names the limit, so that the user can raise it.
class LimitError : public Error {
public:
    /// name      of the limit, e.g. "primitives"
    /// includes  as of SceneError
    LimitError(const std::string& message, const std::string& name, const std::string& includes = {})
        : Error(Fault::limit, message + " (limit: " + name + ")" + includes)
    {
    }
};

}  // namespace firstray::inline v0
