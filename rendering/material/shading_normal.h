// The normal that force shading takes for a contact: interpolated between the corners' normals
// (Phong, "Illumination for computer generated pictures", CACM 18(6), 1975). detail_at() calls it.
#pragma once

#include "rendering/material/surface_detail.h"

namespace tactus::rendering {

// Returns the unit normal for a contact, in the object's frame; the mesh has corner normals.
//
// On a face it is interpolated at the contact's point. On an edge the contact's normal is a mixture
// of the normals of the two faces, and the result is the same mixture of their interpolated
// normals: a smooth edge, where these are one, has one normal, and over a sharp one it turns with
// the sphere that rolls over it. On a vertex it is the normal that the faces agree on, or else the
// contact's own.
Vec3 shading_normal(std::span<const CornerNormals> corners, const ConnectedMesh& mesh,
                    const SurfaceContact& contact);

}  // namespace tactus::rendering
