// Coarser and coarser copies of a picture, for lookups that do not alias.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/material/texture.h"

namespace tactus::host {

// The bytes of rendering::TextureView from those of its finest level, rows from the top. Each level
// is low-passed so that waves of two of its texels and shorter are weakened to less than 1 percent,
// and waves of five texels and longer kept to 1; the picture repeats at its borders. The result
// depends on the input alone. `texels` has width x height x format bytes, each side from 1 to
// kMaxTextureSide.
std::vector<std::uint8_t> build_mip_pyramid(std::span<const std::uint8_t> texels,
                                            rendering::TextureSize size,
                                            rendering::TextureFormat format);

}  // namespace tactus::host
