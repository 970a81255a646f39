#pragma once
#include <cstdint>

namespace firstray::test {

/// While this lives, one allocation of this thread fails: throws std::bad_alloc. One at a time.
class FailingNew {
public:
    /// number  of the allocation that fails, counted from 0 on
    explicit FailingNew(std::int64_t number);
    ~FailingNew();
    FailingNew(const FailingNew&) = delete;
    FailingNew& operator=(const FailingNew&) = delete;

    bool has_failed() const;
};

}  // namespace firstray::test
