// Makes coarser and coarser copies of a picture, so that a lookup at any resolution has no alias
// waves.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "rendering/material/texture.h"

namespace tactus::host {

// Returns the bytes of rendering::TextureView: the finest level, which is `texels`, then ever
// coarser ones, rows from the top. `texels` has width x height x format bytes, each side from 1 to
// kMaxTextureSide; the picture repeats at its borders. Each level is low-pass filtered: waves of
// two of its texels or shorter keep less than 1 % of their amplitude, waves of five texels or
// longer keep all. The result depends on the input alone.
std::vector<std::uint8_t> build_mip_pyramid(std::span<const std::uint8_t> texels,
                                            rendering::TextureSize size,
                                            rendering::TextureFormat format);

}  // namespace tactus::host
