#include "tests/unit/rendering/implicit/plain_tracking.h"

namespace tactus::rendering {

Seed seed(const FormulaView& formula, const Vec3& start) {
  constexpr int kMostSteps = 50;
  constexpr double kSmallestStep = 1e-13;
  Seed result{.point = start};
  for (int step = 0; step < kMostSteps; ++step) {
    const ValueAndGradient f = evaluate_gradient(formula, result.point);
    const Vec3 move = f.value / f.gradient.squaredNorm() * f.gradient;
    if (!move.allFinite()) {
      return result;
    }
    result.point -= move;
    if (move.norm() < kSmallestStep) {
      result.converged = true;
      return result;
    }
  }
  return result;
}

Seed plain_tracking_step(const FormulaView& formula, const Vec3& contact, const Vec3& tool) {
  const Vec3 gradient = evaluate_gradient(formula, contact).gradient;
  const double squared = gradient.squaredNorm();
  if (!(squared > 0.0)) {
    return {.point = contact};
  }
  return seed(formula, tool - gradient.dot(tool - contact) / squared * gradient);
}

}  // namespace tactus::rendering
