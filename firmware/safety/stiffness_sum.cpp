#include "firmware/safety/stiffness_sum.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/safety/field_pieces.h"

namespace tactus::firmware {
namespace {

using rendering::Bounds;

// The cost of the pieces of one more field, in looks of some 60 ns (safety/pushing_together.cpp).
constexpr std::size_t kLooksOfAField = 32;

// Returns the largest stiffness in any direction.
double largest_eigenvalue(const Mat3& symmetric) {
  return Eigen::SelfAdjointEigenSolver<Mat3>(symmetric, Eigen::EigenvaluesOnly).eigenvalues()[2];
}

// The stiffness of the parts whose directions are the same everywhere in the box.
struct Fixed {
  // The sum of K n n^T, N/m.
  Mat3 directed = Mat3::Zero();
  // The sum of the stiffnesses that are equal in all directions, N/m.
  double alike = 0.0;

  [[nodiscard]] double most() const {
    return alike + (directed.isZero(0.0) ? 0.0 : largest_eigenvalue(directed));
  }
};

// Adds a part. A spring across an axis is one in all directions less one along the axis.
void add(const Bounds& box, const ScenePart& part, Fixed& sum) {
  const double stiffness = stiffness_in(box, part);
  const Mat3 along = stiffness * part.axis_W * part.axis_W.transpose();
  switch (part.directions) {
    case SpringDirections::along_axis:
      sum.directed += along;
      break;
    case SpringDirections::across_axis:
      sum.directed -= along;
      sum.alike += stiffness;
      break;
    default:
      sum.alike += stiffness;
      break;
  }
}

// Returns the sum of the stiffnesses of all fields of boxes, N/m.
double sum_of_fields(std::span<const ScenePart> parts) {
  double sum = 0.0;
  for (const ScenePart& part : parts) {
    sum += part.field_box != nullptr ? part.felt.stiffness_N_per_m : 0.0;
  }
  return sum;
}

// Searches the choices of one piece for each field of a box, depth first. A branch ends if it
// cannot exceed the largest sum found so far (branch and bound). It does not recurse: a stack of
// choices takes a twentieth of the memory, and its size is known.
class PieceSum {
 public:
  PieceSum(std::span<const ScenePart> parts, const Fixed& fixed, std::size_t& looks_left)
      : parts_(parts),
        looks_left_(looks_left),
        fields_N_per_m_(sum_of_fields(parts)),
        most_possible_(fixed.most() + fields_N_per_m_) {}

  // Returns the largest stiffness somewhere in the box, N/m. `fixed` is that of the constructor.
  double most_in(const Bounds& box, const Fixed& fixed, double enough_N_per_m) {
    if (fields_N_per_m_ == 0.0 || most_possible_ <= enough_N_per_m) {
      return most_possible_;
    }
    enter(0, {.box = box, .sum = fixed, .left_N_per_m = fields_N_per_m_});
    while (depth_ > 0 && !is_done()) {
      try_next_piece();
    }
    return looks_left_ > 0 ? std::max(largest_, 0.0) : most_possible_;
  }

 private:
  // A choice of a piece for one field. All fields before it have their pieces.
  struct Choice {
    std::size_t part = 0;
    std::size_t next_piece = 0;
    // The fixed parts and the pieces chosen so far push here.
    Bounds box;
    // Their stiffness.
    Fixed sum;
    // The stiffness of this field and those after it, N/m.
    double left_N_per_m = 0.0;
  };

  // Pays for a part of the search.
  void take(std::size_t looks) { looks_left_ -= std::min(looks_left_, looks); }

  // Returns true if the search may end: it is paid out, or nothing larger is possible.
  [[nodiscard]] bool is_done() const {
    constexpr double kRoundingOfSums = 1e-12;
    return looks_left_ == 0 || largest_ >= (1.0 - kRoundingOfSums) * most_possible_;
  }

  // Returns true if every part pushes somewhere in the box.
  [[nodiscard]] bool has_place(const Bounds& box) const {
    return std::ranges::all_of(
        parts_, [&](const ScenePart& part) { return has_point_in(box, part.region); });
  }

  // Begins a choice for the first field from part `next` on. Notes the sum if there is none.
  void enter(std::size_t next, const Choice& choice) {
    while (next < parts_.size() && parts_[next].field_box == nullptr) {
      ++next;
    }
    if (is_done() || choice.sum.most() + choice.left_N_per_m <= largest_) {
      return;
    }
    if (next == parts_.size()) {
      largest_ = choice.sum.most();
      return;
    }
    take(kLooksOfAField);
    choices_[depth_] = choice;
    choices_[depth_++].part = next;
  }

  // Chooses the next piece of the deepest field, or gives the field up if it has no other.
  void try_next_piece() {
    Choice& choice = choices_[depth_ - 1];
    const ScenePart& part = parts_[choice.part];
    if (pieces_of_ != choice.part) {
      pieces_of_ = choice.part;
      pieces_ = pieces_of_box(*part.field_box, part.contact_m, kSamePlace_m);
    }
    if (choice.next_piece == pieces_.count) {
      --depth_;
      return;
    }
    take(1);
    const FieldPiece& piece = pieces_.pieces[choice.next_piece++];
    const Bounds common = common_box(choice.box, piece.box);
    if (has_place(common)) {
      const double stiffness = part.felt.stiffness_N_per_m;
      enter(choice.part + 1,
            {.box = common,
             .sum = {.directed = choice.sum.directed + stiffness * piece.directions_W,
                     .alike = choice.sum.alike},
             .left_N_per_m = choice.left_N_per_m - stiffness});
    }
  }

  std::span<const ScenePart> parts_;
  std::size_t& looks_left_;
  double fields_N_per_m_;
  // The sum if all fields pushed in the worst direction, N/m.
  double most_possible_;
  double largest_ = -1.0;  // the largest of the choices so far
  std::array<Choice, kMostTogether> choices_;
  std::size_t depth_ = 0;
  // The pieces of the field of part `pieces_of_`; of none at the beginning.
  FieldPieces pieces_;
  std::size_t pieces_of_ = kMostTogether;
};

}  // namespace

double stiffness_in(const Bounds& box, const ScenePart& part) {
  const double most = part.felt.stiffness_N_per_m;
  if (part.falloff.kind == Falloff::Kind::none) {
    return most;
  }
  const double away_m = box.distance(part.falloff.middle_W);
  if (part.falloff.kind == Falloff::Kind::bounded_spring) {
    return away_m > 0.0 ? std::min(most, part.falloff.largest_force_N / away_m) : most;
  }
  const double cores = away_m / part.falloff.core_m;
  const double spread = 1.0 + cores * cores;
  return std::min(most, part.falloff.steepness / (spread * std::sqrt(spread)));
}

double stiffness_together(const Bounds& box, std::span<const ScenePart> parts,
                          double enough_N_per_m, std::size_t& looks_left) {
  Fixed fixed;
  for (const ScenePart& part : parts) {
    if (part.field_box == nullptr) {
      add(box, part, fixed);
    }
  }
  return PieceSum(parts, fixed, looks_left).most_in(box, fixed, enough_N_per_m);
}

}  // namespace tactus::firmware
