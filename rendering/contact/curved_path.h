// Lengthens the proxy's straight moves on a curved path, so that few of them follow it.
#pragma once

#include <array>
#include <limits>

#include "rendering/contact/contact_planes.h"
#include "rendering/contact/proxy_rest.h"
#include "rendering/geometry/triangle.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// On an edge or a vertex the sphere's centre moves on a cylinder or a sphere of the radius R, and
// tangent moves alone reduce the distance to the goal only by the ratio depth / R per sub-goal. A
// move lengthened by 1 / (1 - ratio) ends on the ray from the feature through the goal, and the
// next sub-goal drops straight onto it. If the tool lies beyond the feature the sphere rolls off in
// ever longer moves. Along the crease of two surfaces the ratio is that of the last two moves.
//
// The distance to the tool may grow during a lengthened move. A move is lengthened only if the
// plain move would end nearer to the tool than every plain move that was lengthened before in this
// tick.
//
// One object serves the sub-goals of one tick.
class CurvedPath {
 public:
  // Returns the move from the proxy `p` along the planes, lengthened or as it is; `h` is the tool
  // (world frame, m). `planes` bound the end of the move. `triangle` is the one of the first plane
  // of `rest`, needed where its feature is an edge.
  Vec3 lengthen(const Vec3& move, const Vec3& p, const Vec3& h, const ProxyRest& rest,
                const ContactPlanes& planes, const Triangle& triangle);

  // Remembers the last move along the crease of two planes; zero if it was lengthened.
  void remember_crease(const Vec3& move) { last_crease_move_ = move; }

 private:
  // The curvature of the path of the proxy's centre.
  struct Curvature {
    // The ratio of one plain move to the next; 0 if the path is flat or its curvature is not known.
    double ratio = 0.0;
    // The part of the move that changes by the ratio, m.
    Vec3 part = Vec3::Zero();
    // The most that a move may be lengthened to, as a share of the feature's distance from the
    // centre.
    double max_share_of_radius = 0.25;
  };

  // Returns the curvature of the path round an edge or a vertex; flat on a face.
  [[nodiscard]] static Curvature at_feature(const Vec3& move, const Vec3& p, const Vec3& h,
                                            const ProxyRest& rest, const Triangle& triangle);
  // Returns the curvature along the crease of two planes, from the last two moves.
  [[nodiscard]] Curvature along_crease(const Vec3& move, const ProxyRest& rest) const;

  // The distance before any move was lengthened.
  static constexpr double kFar = std::numeric_limits<double>::infinity();
  // The last move along a crease, m; zero if there was none or it was lengthened.
  Vec3 last_crease_move_ = Vec3::Zero();
  // The least distances to the tool (m) after plain moves that were lengthened on one and on two
  // planes.
  std::array<double, 2> least_left_m_{kFar, kFar};
};

}  // namespace tactus::rendering
