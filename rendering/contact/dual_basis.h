// The dual basis of the normals of the planes that hold a proxy.
#pragma once

#include <array>

#include "rendering/contact/proxy_rest.h"
#include "rendering/geometry/vector.h"

namespace tactus::rendering {

// The vectors m_i of the first plane_count entries lie in the space of the normals n_j, and m_i .
// n_j is 1 for i = j and 0 otherwise. A stretch s over the planes has the pressures m_i . s.
using DualBasis = std::array<Vec3, 3>;

// Returns the dual basis of the active planes' normals; zeros if normals are nearly parallel or lie
// nearly in one plane.
DualBasis dual_basis(const ProxyRest& rest);

}  // namespace tactus::rendering
