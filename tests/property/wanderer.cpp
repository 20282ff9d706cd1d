#include "tests/property/wanderer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace tactus::testing {

std::vector<Shape> wandered_shapes() {
  std::vector<Shape> list{
      icosphere(0.03, 2),
      bumpy_sphere(0.03, 2, 0.2),
      box({0.04, 0.05, 0.06}),
      sliver_box({0.04, 0.05, 0.06}, 1e-6),
      torus(0.03, 0.012, 16, 10),
      prism(3, 0.03, 0.04),
      cone(12, 0.02, 0.06),
      star(5, 0.03, 0.012, 0.04),
      grooved_block(30, 0.03),
      grooved_block(10, 0.03),
      grooved_block(2, 0.03),
      blade(30, 0.04),
      blade(10, 0.04),
      blade(2, 0.04),
      slotted_block(0.0015, 0.02),
      pit(0.02, 0.03),
      box({0.05, 0.0001, 0.05}),
      doubled(turned(box({0.03, 0.04, 0.05}), {1, 2, 3}, 0.7)),
      joined(icosphere(0.02, 1), moved(box({0.03, 0.03, 0.03}), {0.02, 0.01, 0.0})),
      joined(box({0.05, 0.01, 0.05}), moved(box({0.05, 0.01, 0.05}), {0.0, 0.0115, 0.0})),
      height_field(0.08, 12, 0.006),
      moebius(0.03, 0.02, 40),
      helicoid(0.03, 0.02, 24),
      triangle_soup(7, 60, 0.08),
      open_tube(14, 0.015, 0.05),
  };
  return list;
}

Vec3 Wanderer::next() {
  if (ticks_left_-- <= 0) {
    choose_target();
  }
  const Vec3 way = target_ - tool_;
  const double distance = way.norm();
  if (distance > 0.0) {
    tool_ += std::min(1.0, speed_ / distance) * way;
  }
  return tool_ +
         0.1 * speed_ * Vec3{signed_unit_(random_), signed_unit_(random_), signed_unit_(random_)};
}

void Wanderer::choose_target() {
  const auto pick =
      std::uniform_int_distribution<std::size_t>(0, shape_.triangles.size() - 1)(random_);
  double u = unit_(random_);
  double v = unit_(random_);
  if (u + v > 1.0) {
    u = 1.0 - u;
    v = 1.0 - v;
  }
  const auto& t = shape_.triangles[pick];
  const Vec3 a = rendering::to_vec3(shape_.vertices[t[0]]);
  const Vec3 point = a + u * (rendering::to_vec3(shape_.vertices[t[1]]) - a) +
                     v * (rendering::to_vec3(shape_.vertices[t[2]]) - a);
  target_ =
      point + 0.006 * Vec3{signed_unit_(random_), signed_unit_(random_), signed_unit_(random_)};
  speed_ = std::pow(10.0, -6.0 + 4.5 * unit_(random_));
  ticks_left_ = 1 + static_cast<int>(60.0 * unit_(random_));
}

}  // namespace tactus::testing
