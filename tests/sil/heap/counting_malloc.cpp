// glibc's allocator under its own names stays what allocates; these count on the way.
#include "sil/heap/counting_malloc.hpp"

#include <sys/syscall.h>
#include <sys/types.h>
#include <unistd.h>

#include <atomic>
#include <cstddef>

namespace {

std::atomic<bool> g_counting{false};
std::atomic<long> g_count{0};

void note() {
    if (g_counting.load(std::memory_order_relaxed)) {
        g_count.fetch_add(1, std::memory_order_relaxed);
    }
}

}  // namespace

extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);

void* malloc(std::size_t bytes) noexcept {
    note();
    return __libc_malloc(bytes);
}
void* calloc(std::size_t n, std::size_t bytes) noexcept {
    note();
    return __libc_calloc(n, bytes);
}
void* realloc(void* old, std::size_t bytes) noexcept {
    note();
    return __libc_realloc(old, bytes);
}
void* aligned_alloc(std::size_t alignment, std::size_t bytes) noexcept {
    note();
    return __libc_memalign(alignment, bytes);
}
void* memalign(std::size_t alignment, std::size_t bytes) noexcept {
    note();
    return __libc_memalign(alignment, bytes);
}
int posix_memalign(void** out, std::size_t alignment, std::size_t bytes) noexcept {
    note();
    *out = __libc_memalign(alignment, bytes);
    return *out == nullptr ? 12 : 0;  // ENOMEM
}
/// Of programs and libraries; the allocator's own do not pass here.
void* mmap(void* at, std::size_t bytes, int protection, int flags, int file, off_t offset) noexcept {
    note();
    return reinterpret_cast<void*>(::syscall(SYS_mmap, at, bytes, protection, flags, file, offset));
}
}

namespace semtrack {

AllocationCounter::AllocationCounter() {
    g_count = 0;
    g_counting = true;
}
AllocationCounter::~AllocationCounter() {
    g_counting = false;
}
long AllocationCounter::count() const {
    return g_count;
}

}  // namespace semtrack
