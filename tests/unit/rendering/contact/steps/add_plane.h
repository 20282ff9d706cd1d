// Adds a plane to the contact planes as collecting does.
#pragma once

#include "rendering/contact/contact_planes.h"

namespace tactus::testing {

// Returns true if the plane was added.
inline bool add_plane(rendering::ContactPlanes& planes, const rendering::ContactPlane& contact,
                      std::uint32_t& flags) {
  rendering::ContactPlane* const place = planes.add(contact.plane, contact.nearest.distance, flags);
  if (place != nullptr) {
    *place = contact;
  }
  return place != nullptr;
}

}  // namespace tactus::testing
