#pragma once
#include <cstdint>

// Sanitizers have an operator new of their own.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
#define FIRSTRAY_NEW_CANNOT_FAIL 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer) || __has_feature(address_sanitizer)
#define FIRSTRAY_NEW_CANNOT_FAIL 1
#endif
#endif

namespace firstray::test {

#ifdef FIRSTRAY_NEW_CANNOT_FAIL
inline constexpr bool new_can_fail = false;
#else
inline constexpr bool new_can_fail = true;
#endif

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
