#include "rendering/bodies/solid_hulls.h"

namespace tactus::rendering {

void SolidHulls::place(const SolidList& solids, std::size_t solid) {
  if (solids.is_body(solid)) {
    place_body(solids, solid);
  } else if (const BodyObstacle& obstacle = solids.obstacle_of(solid); obstacle.has_hull()) {
    hulls_[solid].place(obstacle.hull, obstacle.X_WO);
  }
}

void SolidHulls::place_body(const SolidList& solids, std::size_t body) {
  const BodyStart& start = solids.starts()[body];
  const RigidPose X_WO = solids.bodies()[body].pose();
  if (start.parts.empty()) {
    hulls_[body].place(start.body.hull, X_WO);
    return;
  }
  const auto placed = std::span(part_hulls_).subspan(solids.first_part(body), start.parts.size());
  for (std::size_t i = 0; i < placed.size(); ++i) {
    placed[i].place(start.parts[i], X_WO);
  }
  hulls_[body].enclose(placed);
}

std::span<const PlacedHull> SolidHulls::parts_of(const SolidList& solids, std::size_t solid) const {
  const std::size_t parts = solids.is_body(solid) ? solids.starts()[solid].parts.size() : 0;
  return parts == 0 ? std::span(hulls_).subspan(solid, 1)
                    : std::span(part_hulls_).subspan(solids.first_part(solid), parts);
}

}  // namespace tactus::rendering
