#include "rendering/scene/stored_counts.h"

#include <algorithm>

namespace tactus::rendering {

SceneCounts stored_counts(const image::Scene& scene) {
  SceneCounts counts{.objects = scene.objects()->size(),
                     .tools = scene.tool_count(),
                     .effects = scene.effects() == nullptr ? 0 : scene.effects()->size()};
  for (const image::Object* const object : *scene.objects()) {
    counts.tissues += object->tissue() != nullptr ? 1U : 0U;
    if (const image::Body* const body = object->body(); body != nullptr) {
      const std::size_t parts = body->parts() == nullptr ? 0 : body->parts()->size();
      ++counts.bodies;
      counts.body_parts += parts;
      counts.parts_of_body = std::max(counts.parts_of_body, parts);
    }
  }
  return counts;
}

}  // namespace tactus::rendering
