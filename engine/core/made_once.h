#pragma once
#include <atomic>
#include <cstdint>
#include <memory>
#include <type_traits>

#ifndef FIRSTRAY_MUTANT
#define FIRSTRAY_MUTANT 0  // 1, 2, 3: a fault on purpose, which tests/core/made_once_test.cpp must catch
#endif

namespace firstray::inline v0 {

/// Something that the first thread to ask for it makes; the others do not wait but do without. One atomic word:
/// not made -> being made -> made (a pointer), or refused until the next reset.
template <typename T>
class MadeOnce {
public:
    MadeOnce() = default;
    MadeOnce(const MadeOnce&) = delete;
    MadeOnce& operator=(const MadeOnce&) = delete;
    ~MadeOnce() { delete get(); }

    /// What was made, or null. Any number of threads.
    const T* get() const
    {
        const std::uintptr_t word = word_.load(std::memory_order_acquire);  // pairs with the store that publishes
        return word > refused ? reinterpret_cast<const T*>(word) : nullptr;
    }

    /// The same, to be changed. Runs alone.
    T* get_alone() { return const_cast<T*>(get()); }

    /// The same, but makes it first where nobody has begun to. Any number of threads.
    /// make  returns a unique_ptr to what was made, null to refuse; must not throw
    template <typename Make>
    const T* get_or_make(const Make& make)
    {
        if (const T* made = get()) return made;
        std::uintptr_t expected = not_made;
        const bool is_first = word_.compare_exchange_strong(expected, being_made, std::memory_order_acquire);
        if (!is_first && FIRSTRAY_MUTANT != 2) return get();
        if constexpr (FIRSTRAY_MUTANT == 3 && std::is_default_constructible_v<T>) {
            T* const early = new T();
            word_.store(reinterpret_cast<std::uintptr_t>(early), std::memory_order_release);
            if (std::unique_ptr<T> late = make()) *early = std::move(*late);
            return early;
        }
        std::unique_ptr<T> fresh = make();
        const T* const made = fresh.release();
        word_.store(made ? reinterpret_cast<std::uintptr_t>(made) : refused, publish);
        return made;
    }

    /// Whether it was to be made and could not be. Any number of threads.
    bool is_refused() const { return word_.load(std::memory_order_relaxed) == refused; }

    /// Lets a refusal be asked again. Runs alone.
    void forget_refusal()
    {
        if (is_refused()) word_.store(not_made, std::memory_order_relaxed);
    }

    /// Takes out what was made, or nothing, and forgets a refusal. Runs alone.
    std::unique_ptr<T> take()
    {
        std::unique_ptr<T> made(const_cast<T*>(get()));
        word_.store(not_made, std::memory_order_relaxed);
        return made;
    }

    /// Puts in what was made elsewhere; nothing is in it. Runs alone.
    void put(std::unique_ptr<T> made)
    {
        word_.store(reinterpret_cast<std::uintptr_t>(made.release()), std::memory_order_relaxed);
    }

private:
    static constexpr std::memory_order publish =
        FIRSTRAY_MUTANT == 1 ? std::memory_order_relaxed : std::memory_order_release;
    static constexpr std::uintptr_t not_made = 0, being_made = 1, refused = 2;
    std::atomic<std::uintptr_t> word_{not_made};
};

}  // namespace firstray::inline v0
