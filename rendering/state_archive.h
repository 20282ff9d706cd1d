// Writes what an object remembers into bytes, or reads it back: one function per class names its
// members, for both ways, so that the two cannot differ.
//
//   void ForceLimiter::transfer(StateArchive& archive) {
//     auto& [max_force_N, gain, last_W] = *this;  // every member: a new one fails to compile here
//     archive(gain, last_W);                      // and those that are not the configuration's
//   }
//
// Plain numbers and indices, no addresses, little-endian: the bytes mean the same in another
// process and on another processor of 64 bits. They come from outside when they are read: numbers
// that are not finite, and what require() refuses, end it.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// An archive without heap, for one thread. It never writes beyond its buffer and never reads beyond
// the end: good() is then false, and what is read is zero. A writer never changes a member.
class StateArchive {
 public:
  // Return an archive that writes into `room`, or one that reads `bytes`.
  static StateArchive writer(std::span<std::byte> room) { return {room, {}, false}; }
  static StateArchive reader(std::span<const std::byte> bytes) { return {{}, bytes, true}; }

  // Returns true for a reader.
  [[nodiscard]] bool is_reading() const { return is_reading_; }
  // Returns false once anything has failed; nothing is read or written from then on.
  [[nodiscard]] bool good() const { return good_; }
  // Returns the number of bytes so far.
  [[nodiscard]] std::size_t size() const { return place_; }
  // Returns true if everything was read.
  [[nodiscard]] bool at_end() const { return place_ == from_.size(); }

  // Rejects the state if `holds` is false for the members read or to be written.
  void require(bool holds) { good_ = good_ && holds; }

  // Transfers numbers, vectors, arrays of them, and classes with a transfer() of their own, in this
  // order.
  template <class... Members>
  void operator()(Members&... members) {
    (item(members), ...);
  }

  // Transfers an enumerator from 0 to `last`; another value is refused.
  template <class Enum>
  void choice(Enum& value, Enum last) {
    auto number = static_cast<std::uint8_t>(value);
    bytes(&number, sizeof number);
    require(number <= static_cast<std::uint8_t>(last));
    if (is_reading_) {
      value = good_ ? static_cast<Enum>(number) : Enum{};
    }
  }

  // Transfers a count or an index that is at most `most`; a larger one is refused and read as 0.
  template <std::unsigned_integral Number>
  void up_to(Number& value, std::type_identity_t<Number> most) {
    item(value);
    require(value <= most);
    if (is_reading_ && !good_) {
      value = 0;
    }
  }

  // Writes a value that the reader must have too, such as the number of a scene's objects.
  void same(std::uint64_t value) {
    std::uint64_t theirs = value;
    item(theirs);
    require(theirs == value);
  }

  // Transfers all vertices at once.
  void vertices(std::span<Float3> values) {
    bytes(values.data(), values.size_bytes());
    for (const Float3& v : values) {
      good_ = good_ && std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    }
  }

 private:
  static_assert(std::endian::native == std::endian::little);

  StateArchive(std::span<std::byte> to, std::span<const std::byte> from, bool is_reading)
      : to_(to), from_(from), is_reading_(is_reading) {}

  // Transfers raw bytes. A reader that has too few gives zeros.
  void bytes(void* members, std::size_t size) {
    const std::size_t room = (is_reading_ ? from_.size() : to_.size()) - place_;
    if (!good_ || size > room) {
      good_ = false;
      if (is_reading_) {
        std::memset(members, 0, size);
      }
      return;
    }
    if (is_reading_) {
      std::memcpy(members, from_.data() + place_, size);
    } else {
      std::memcpy(to_.data() + place_, members, size);
    }
    place_ += size;
  }

  void item(bool& value) {
    std::uint8_t number = value ? 1 : 0;
    bytes(&number, sizeof number);
    require(number <= 1);
    if (is_reading_) {
      value = number == 1;
    }
  }

  template <std::unsigned_integral Number>
  void item(Number& value) {
    bytes(&value, sizeof value);
  }

  template <std::floating_point Number>
  void item(Number& value) {
    bytes(&value, sizeof value);
    require(std::isfinite(value));
  }

  template <int Rows, int Columns>
  void item(Eigen::Matrix<double, Rows, Columns>& matrix) {
    bytes(matrix.data(), sizeof(double) * static_cast<std::size_t>(matrix.size()));
    require(matrix.allFinite());
  }

  template <class Value, std::size_t kSize>
  void item(std::array<Value, kSize>& values) {
    for (Value& value : values) {
      item(value);
    }
  }

  template <class State>
    requires std::is_class_v<State>
  void item(State& state) {
    if constexpr (requires { state.transfer(*this); }) {
      state.transfer(*this);
    } else {
      transfer(*this, state);
    }
  }

  std::span<std::byte> to_;
  std::span<const std::byte> from_;
  // The place of the next byte.
  std::size_t place_ = 0;
  bool is_reading_;
  bool good_ = true;
};

}  // namespace tactus::rendering
