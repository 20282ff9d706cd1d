#include "host_tools/benchmark/multiplications.h"

#include "host_tools/benchmark/counted_number.h"
#include "rendering/geometry/plane_solutions.h"
#include "rendering/geometry/vector.h"

namespace tactus::host {
namespace {

using CountedVector = Eigen::Matrix<CountedNumber, 3, 1>;
using CountedPlane = rendering::HalfSpace<CountedNumber>;
using CountedSolution = rendering::PlaneSolution<CountedNumber>;

CountedVector counted(const Vec3& v) {
  return {CountedNumber(v.x()), CountedNumber(v.y()), CountedNumber(v.z())};
}

// Returns the multiplications of a solution; none if a plane does not push.
template <class Solve>
std::size_t products_of(const Solve& solve) {
  CountedNumber::products = 0;
  CountedSolution solution;
  return solve(solution) ? CountedNumber::products : 0;
}

}  // namespace

Multiplications count_multiplications() {
  // Three walls of a corner, and a tool behind all of them, m.
  const std::array<CountedPlane, 3> walls{
      {{.normal = counted(Vec3(1.0, 0.2, -0.1).normalized()), .offset = CountedNumber(0.01)},
       {.normal = counted(Vec3(-0.3, 1.0, 0.2).normalized()), .offset = CountedNumber(0.02)},
       {.normal = counted(Vec3(0.1, -0.2, 1.0).normalized()), .offset = CountedNumber(0.03)}}};
  const CountedVector tool = counted({-0.01, -0.02, -0.03});
  return {products_of([&](CountedSolution& s) { return solve_one_plane(tool, walls[0], s); }),
          products_of(
              [&](CountedSolution& s) { return solve_two_planes(tool, walls[0], walls[1], s); }),
          products_of([&](CountedSolution& s) {
            return solve_three_planes(tool, walls[0], walls[1], walls[2], s);
          })};
}

}  // namespace tactus::host
