#include "tests/support/heap_trap.h"

#include <atomic>
#include <cerrno>

// glibc's own names for the functions that are replaced below.
// NOLINTBEGIN(readability-*)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}

namespace {

std::atomic<bool> g_set = false;
std::atomic<std::size_t> g_calls = 0;

void count() {
  if (g_set.load(std::memory_order_relaxed)) {
    g_calls.fetch_add(1, std::memory_order_relaxed);
  }
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  count();
  return __libc_malloc(size);
}

void* calloc(std::size_t times, std::size_t size) {
  count();
  return __libc_calloc(times, size);
}

void* realloc(void* block, std::size_t size) {
  count();
  return __libc_realloc(block, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  count();
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  count();
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? ENOMEM : 0;
}

void free(void* block) {
  count();
  __libc_free(block);
}
}
// NOLINTEND(readability-*)

namespace tactus::testing {

HeapTrap::HeapTrap() {
  g_calls = 0;
  g_set = true;
}

HeapTrap::~HeapTrap() {
  g_set = false;
}

std::size_t HeapTrap::calls() const {
  return g_calls;
}

}  // namespace tactus::testing
