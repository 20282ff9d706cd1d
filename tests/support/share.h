// The share of its work that a long test does: where a sanitizer or an emulator makes it thirty
// times slower it does less, in a soak more. tests/checks/build_and_test.sh says how much.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdlib>
#include <span>

namespace tactus::testing {

// Returns the count in the proportion of TACTUS_PROPERTY_TICKS to a million; all of it if that is
// not set.
template <std::integral Count>
Count share_of(Count count) {
  constexpr double kMillion = 1e6;
  const char* wanted = std::getenv("TACTUS_PROPERTY_TICKS");
  const double share = wanted != nullptr ? std::strtod(wanted, nullptr) / kMillion : 1.0;
  return std::max(Count{1}, static_cast<Count>(share * static_cast<double>(count)));
}

// The same of what there is no more of, in a soak neither: the rows of a table, the ticks of a path
// with an end.
template <std::integral Count>
Count part_of(Count count) {
  return std::min(count, share_of(count));
}

// Returns the first of a list's entries in the same proportion, one at least.
template <class Entry, std::size_t N>
std::span<const Entry> part_of(const std::array<Entry, N>& all) {
  return std::span(all).first(part_of(N));
}

}  // namespace tactus::testing
