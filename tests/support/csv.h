// Reads a table of numbers with a header line; the reference results in tests/reference.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "rendering/geometry/vector.h"

namespace tactus::testing {

class Csv {
 public:
  // Throws std::runtime_error naming the file if it cannot be read.
  explicit Csv(const std::string& name);

  [[nodiscard]] std::size_t rows() const { return cells_.size(); }
  [[nodiscard]] const std::string& text(std::size_t row, const std::string& column) const;
  // Returns the cell's number, or NaN for an empty cell.
  [[nodiscard]] double number(std::size_t row, const std::string& column) const;
  // Returns the vector in the columns PREFIXx, PREFIXy and PREFIXz.
  [[nodiscard]] Vec3 vector(std::size_t row, const std::string& prefix) const;

 private:
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> cells_;
};

}  // namespace tactus::testing
