// The known name that is nearest to one that the user wrote, for "did you mean" advice.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

namespace tactus::host {

// Returns the Levenshtein distance: how many letters must be inserted, removed or replaced. It
// keeps one row of the usual table.
inline std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) {
    row[j] = j;
  }
  for (std::size_t i = 1; i <= a.size(); ++i) {
    // The entry up and to the left, which the row has lost already.
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row.back();
}

// Keeps the known name that is nearest to a written one. It is near if at most a third of the
// letters, or one, differ.
class NearestName {
 public:
  explicit NearestName(std::string_view written) : written_(written) {}

  // Compares a known name.
  void consider(std::string_view name) {
    if (const std::size_t distance = edit_distance(written_, name); distance < distance_) {
      distance_ = distance;
      nearest_ = name;
    }
  }
  // Returns the nearest name, or nothing if none is near.
  [[nodiscard]] std::optional<std::string_view> found() const {
    const bool is_near = distance_ <= std::max<std::size_t>(1, written_.size() / 3);
    return is_near ? std::optional(nearest_) : std::nullopt;
  }

 private:
  std::string_view written_;
  std::string_view nearest_;
  std::size_t distance_ = std::numeric_limits<std::size_t>::max();
};

}  // namespace tactus::host
