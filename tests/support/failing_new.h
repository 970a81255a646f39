#pragma once
#include <cstdint>

namespace firstray::test {

/// Whose allocations fail.
enum class Allocations { of_this_thread, of_all_threads };

/// While this lives, one allocation fails: throws std::bad_alloc. One at a time.
class FailingNew {
public:
    /// number  of the allocation that fails, counted from 0 on
    explicit FailingNew(std::int64_t number, Allocations whose = Allocations::of_this_thread);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    bool has_failed() const;
};

}  // namespace firstray::test
