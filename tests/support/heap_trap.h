// Counts every use of the heap by this program while a trap is set: malloc and its relatives are
// replaced, and operator new rests on them. Link heap_trap.cpp into the test program itself; not
// together with a sanitizer, which replaces them too.
#pragma once

#include <cstddef>

namespace tactus::testing {

class HeapTrap {
 public:
  HeapTrap();
  ~HeapTrap();
  HeapTrap(const HeapTrap&) = delete;
  HeapTrap& operator=(const HeapTrap&) = delete;

  // Calls of malloc, calloc, realloc, aligned_alloc, posix_memalign and free since the trap was
  // set.
  [[nodiscard]] std::size_t calls() const;
};

}  // namespace tactus::testing
