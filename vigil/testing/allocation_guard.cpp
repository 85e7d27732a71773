#include "vigil/testing/allocation_guard.hpp"

#include <cerrno>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VIGIL_SANITIZER_ALLOCATES 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define VIGIL_SANITIZER_ALLOCATES 1
#endif
#endif

namespace {

// Constant initialisation and no destructor: usable from the first allocation of a thread to its last.
constinit thread_local std::size_t allocations_of_this_thread = 0;

}  // namespace

#ifdef VIGIL_SANITIZER_ALLOCATES

// The sanitizers bring their own malloc, and a hook into it (sanitizer/allocator_interface.h).
extern "C" int __sanitizer_install_malloc_and_free_hooks(void (*on_malloc)(const volatile void*, std::size_t),
                                                         void (*on_free)(const volatile void*));

namespace {

void count_allocation(const volatile void*, std::size_t) { ++allocations_of_this_thread; }
void ignore_release(const volatile void*) {}

[[maybe_unused]] const int hooks_installed =
    __sanitizer_install_malloc_and_free_hooks(count_allocation, ignore_release);

}  // namespace

#else

// glibc lets a program replace malloc, and keeps its own under these names; its free takes back what they gave.
extern "C" {

void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* old, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);

void* malloc(std::size_t size) noexcept {
  ++allocations_of_this_thread;
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) noexcept {
  ++allocations_of_this_thread;
  return __libc_calloc(count, size);
}

void* realloc(void* old, std::size_t size) noexcept {
  ++allocations_of_this_thread;
  return __libc_realloc(old, size);
}

void* memalign(std::size_t alignment, std::size_t size) noexcept {
  ++allocations_of_this_thread;
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) noexcept { return memalign(alignment, size); }

int posix_memalign(void** result, std::size_t alignment, std::size_t size) noexcept {
  *result = memalign(alignment, size);
  return *result == nullptr ? ENOMEM : 0;
}

}  // extern "C"

#endif

namespace vigil::testing {

AllocationGuard::AllocationGuard() : at_start_(allocations_of_this_thread) {}

std::size_t AllocationGuard::allocations() const { return allocations_of_this_thread - at_start_; }

}  // namespace vigil::testing
