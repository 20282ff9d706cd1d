// The normal that force shading takes for a contact: interpolated between the corners' normals.
#pragma once

#include "rendering/material/surface_detail.h"

namespace tactus::rendering {

// On a face, interpolated at the contact's point. On an edge, the contact's normal is a mixture of
// the normals of the two faces; the same mixture of their interpolated normals: a smooth edge,
// where these are one, has one normal, and over a sharp one it turns with the sphere that rolls
// over it. On a vertex, the normal that its faces agree on, or else the contact's own. The mesh has
// corner normals.
Vec3 shading_normal(std::span<const CornerNormals> corners, const ConnectedMesh& mesh,
                    const SurfaceContact& contact);

}  // namespace tactus::rendering
