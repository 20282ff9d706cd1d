#include "tests/support/csv.h"

#include "tests/support/paths.h"

#include <cstdlib>
#include <fstream>
#include <limits>
#include <stdexcept>

namespace tactus::testing {
namespace {

// A comma within quotation marks does not separate.
std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

}  // namespace

Csv::Csv(const std::string& name) {
  const std::string path = in_repository("tests/reference/" + name);
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line)) {
    throw std::runtime_error("cannot read " + path);
  }
  for (const std::string& column : split(line)) {
    columns_.emplace(column, columns_.size());
  }
  while (std::getline(file, line)) {
    cells_.push_back(split(line));
  }
}

const std::string& Csv::text(std::size_t row, const std::string& column) const {
  return cells_.at(row).at(columns_.at(column));
}

double Csv::number(std::size_t row, const std::string& column) const {
  const std::string& cell = text(row, column);
  return cell.empty() ? std::numeric_limits<double>::quiet_NaN()
                      : std::strtod(cell.c_str(), nullptr);
}

Vec3 Csv::vector(std::size_t row, const std::string& prefix) const {
  return {number(row, prefix + "x"), number(row, prefix + "y"), number(row, prefix + "z")};
}

}  // namespace tactus::testing
