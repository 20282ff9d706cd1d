// An array whose length is known when the program starts, such as one element for each device. Its
// memory comes from the kernel, not from the heap. Not real time; using the elements is.
#pragma once

#include <sys/mman.h>

#include <cerrno>
#include <cstddef>
#include <memory>
#include <span>

namespace tactus::firmware {

// The elements live until the end of the array.
template <class T>
class StartupArray {
 public:
  StartupArray() = default;
  StartupArray(const StartupArray&) = delete;
  StartupArray& operator=(const StartupArray&) = delete;
  ~StartupArray() {
    std::destroy(elements_.begin(), elements_.end());
    if (!elements_.empty()) {
      ::munmap(elements_.data(), elements_.size_bytes());
    }
  }

  // Makes `count` elements. Call once. Returns 0 or errno.
  int make(std::size_t count) {
    if (count == 0) {
      return 0;
    }
    void* const memory = ::mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE,
                                MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
      return errno;
    }
    T* const first = static_cast<T*>(memory);
    std::uninitialized_default_construct_n(first, count);
    elements_ = {first, count};
    return 0;
  }

  // Returns the elements; none before make().
  [[nodiscard]] std::span<T> all() const { return elements_; }

 private:
  std::span<T> elements_;
};

}  // namespace tactus::firmware
