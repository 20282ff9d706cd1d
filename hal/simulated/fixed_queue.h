// A first-in first-out queue of fixed capacity, without a heap. One thread.
#pragma once

#include <array>
#include <cstddef>

namespace tactus::hal {

// A queue of at most kCapacity items of type T, which are copied.
template <class T, std::size_t kCapacity>
class FixedQueue {
 public:
  bool empty() const { return size_ == 0; }
  std::size_t size() const { return size_; }
  bool full() const { return size_ == kCapacity; }

  // Appends an item. The queue must not be full.
  void push(const T& item) {
    items_[(first_ + size_) % kCapacity] = item;
    ++size_;
  }

  // Return or remove the oldest item. The queue must not be empty.
  T& front() { return items_[first_]; }
  const T& front() const { return items_[first_]; }
  void pop() {
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }

  void clear() { size_ = 0; }

 private:
  std::array<T, kCapacity> items_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace tactus::hal
