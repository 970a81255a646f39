#include "engine/core/aligned.h"

#ifdef __linux__
#include <sys/mman.h>
#endif

namespace firstray::inline v0 {
namespace {

constexpr std::size_t line = 64, huge_page = std::size_t{1} << 21;

/// Less than this many bytes fill too few huge pages.
constexpr std::size_t large = 2 * huge_page;

std::align_val_t boundary(std::size_t bytes)
{
    return std::align_val_t{bytes < large ? line : huge_page};
}

}  // namespace

void* allocate_lines(std::size_t bytes)
{
    // whole huge pages: up to 511 small ones behind the last would take longer than it
    if (bytes >= large) bytes = (bytes + huge_page - 1) / huge_page * huge_page;
    void* const memory = ::operator new(bytes, boundary(bytes));
#ifdef __linux__
    if (bytes >= large) madvise(memory, bytes, MADV_HUGEPAGE);  // advice: may be refused
#endif
    return memory;
}

void free_lines(void* memory, std::size_t bytes)
{
    ::operator delete(memory, boundary(bytes));
}

}  // namespace firstray::inline v0
