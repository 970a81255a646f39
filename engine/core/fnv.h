#pragma once
#include <cstdint>
#include <cstring>
#include <string_view>

namespace firstray::inline v0 {

// FNV-1a with its 64-bit constants, fed a word a step: a byte a step would take as long as tracing some frames.
// Source: G. Fowler, L. C. Noll, K.-P. Vo, "The FNV Non-Cryptographic Hash Algorithm".
inline constexpr std::uint64_t fnv_offset_basis = 14695981039346656037u;
inline constexpr std::uint64_t fnv_prime = 1099511628211u;

inline std::uint64_t fnv_mixed(std::uint64_t hash, std::uint64_t word)
{
    return (hash ^ word) * fnv_prime;
}

/// Tells changed text from unchanged; no defence against who wants two texts to look the same.
inline std::uint64_t fnv_mixed(std::uint64_t hash, std::string_view text)
{
    hash = fnv_mixed(hash, text.size());
    for (; !text.empty(); text.remove_prefix(text.size() < 8 ? text.size() : 8)) {
        std::uint64_t word = 0;
        std::memcpy(&word, text.data(), text.size() < 8 ? text.size() : 8);
        hash = fnv_mixed(hash, word);
    }
    return hash;
}

}  // namespace firstray::inline v0
