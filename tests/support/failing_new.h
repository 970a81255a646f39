#pragma once
#include <cstdint>

namespace firstray::test {

/// Whose allocations fail.
enum class Allocations { of_this_thread, of_all_threads };

/// While this lives, one allocation fails: throws std::bad_alloc; but not one of OpenImageIO's, which allocates in
/// functions that have promised not to throw. One at a time.
class FailingNew {
public:
    /// number  of the allocation that fails, counted from 0 on
    explicit FailingNew(std::int64_t number, Allocations whose = Allocations::of_this_thread);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    /// Whether its turn has come.
    bool has_failed() const;
    /// Whether it was OpenImageIO's, and so did not fail.
    bool was_spared() const;
};

}  // namespace firstray::test
