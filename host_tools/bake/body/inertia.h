// An inertia that the user gives, and the conditions that every inertia meets.
#pragma once

#include <optional>
#include <span>
#include <string>

#include "rendering/geometry/vector.h"

namespace tactus::host {

// People round the numbers that they write: an inertia may miss symmetry and the triangle
// inequality by this share of its largest moment, five digits.
inline constexpr double kInertiaRounding = 1e-5;

// Returns the inertia about the centre of mass, kg m^2, along the axes of the object: from three
// numbers, the moments about x, y and z, or from nine, the matrix row by row, of which the
// symmetric part is taken. Throws InputError, without a file name, for another count, a number that
// is not finite, a matrix that is not symmetric, and for what inertia_fault() finds.
Mat3 inertia_of_numbers(std::span<const double> numbers_kg_m2);

// Returns nothing if a symmetric matrix is the inertia of some rigid body: its principal moments
// are above 0, and none exceeds the sum of the other two. Otherwise it returns a text that
// continues "its ..." or "the ...".
std::optional<std::string> inertia_fault(const Mat3& inertia);

}  // namespace tactus::host
