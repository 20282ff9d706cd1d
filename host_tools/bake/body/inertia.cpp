#include "host_tools/bake/body/inertia.h"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A principal moment below this share of the largest one is a rounding error of the matrix.
constexpr double kLeastMomentShare = 1e-12;

Mat3 matrix_of(std::span<const double> numbers) {
  constexpr std::size_t kMoments = 3;
  constexpr std::size_t kEntries = 9;
  if (numbers.size() == kMoments) {
    return Vec3(numbers[0], numbers[1], numbers[2]).asDiagonal();
  }
  if (numbers.size() != kEntries) {
    throw InputError(fmt::format(
        "an inertia has 3 numbers, the moments about x, y and z, or 9, the matrix row by row, in "
        "kg m^2; {} are given",
        numbers.size()));
  }
  Mat3 matrix;
  matrix << numbers[0], numbers[1], numbers[2],  //
      numbers[3], numbers[4], numbers[5],        //
      numbers[6], numbers[7], numbers[8];
  return matrix;
}

void require_symmetric(const Mat3& matrix) {
  const double allowed = kInertiaRounding * matrix.cwiseAbs().maxCoeff();
  for (Eigen::Index row = 0; row < 3; ++row) {
    for (Eigen::Index column = row + 1; column < 3; ++column) {
      const double upper = matrix(row, column);
      const double lower = matrix(column, row);
      if (std::abs(upper - lower) > allowed) {
        throw InputError(fmt::format(
            "the inertia is not symmetric: row {} has {} kg m^2 in column {}, and row {} has {} in "
            "column {}; make them equal",
            row + 1, upper, column + 1, column + 1, lower, row + 1));
      }
    }
  }
}

}  // namespace

std::optional<std::string> inertia_fault(const Mat3& inertia) {
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(inertia, Eigen::EigenvaluesOnly);
  const Vec3& moments = solver.eigenvalues();  // the smallest first
  const auto text = [&](const char* fault) {
    return fmt::format("principal moments of inertia, {:.6g}, {:.6g} and {:.6g} kg m^2, {}",
                       moments[0], moments[1], moments[2], fault);
  };
  if (!moments.allFinite() || !(moments[0] > kLeastMomentShare * moments[2])) {
    return text("are not all above 0");
  }
  if (moments[2] - (moments[0] + moments[1]) > kInertiaRounding * moments[2]) {
    return text("are those of no body: the largest exceeds the sum of the other two");
  }
  return std::nullopt;
}

Mat3 inertia_of_numbers(std::span<const double> numbers_kg_m2) {
  const Mat3 matrix = matrix_of(numbers_kg_m2);
  if (!matrix.allFinite()) {
    throw InputError("the inertia has a number that is not finite; give it in kg m^2");
  }
  require_symmetric(matrix);
  const Mat3 inertia = 0.5 * (matrix + matrix.transpose());
  if (const auto fault = inertia_fault(inertia)) {
    throw InputError(fmt::format(
        "the {}; check the numbers, or leave the inertia out to have it computed from the shape",
        *fault));
  }
  return inertia;
}

}  // namespace tactus::host
