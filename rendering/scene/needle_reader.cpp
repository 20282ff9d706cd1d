#include "rendering/scene/needle_reader.h"

#include "rendering/needle/needle_touch.h"
#include "rendering/scene/stored.h"

namespace tactus::rendering {

static_assert(sizeof(Tissue) == 15 * sizeof(double) && offsetof(Tissue, in) == 48 &&
              offsetof(Tissue, shaft_stiffness_N_per_m2) == 96 &&
              sizeof(Needle) == 6 * sizeof(double) && offsetof(Needle, length_m) == 24);

std::expected<Needle, SceneError> read_needle(const image::Needle* stored) {
  Needle needle = stored == nullptr ? Needle{} : *in_place<Needle>(stored);
  if (!valid(needle)) {
    return fail(SceneFault::needle);
  }
  return needle;
}

std::expected<Tissue, SceneError> read_tissue(const image::Tissue& stored, const Needle& needle,
                                              const Object& object) {
  const Tissue& tissue = *in_place<Tissue>(&stored);
  if (!valid(tissue, needle) || !may_be_pierced(object)) {
    return fail(SceneFault::tissue);
  }
  return tissue;
}

}  // namespace tactus::rendering
