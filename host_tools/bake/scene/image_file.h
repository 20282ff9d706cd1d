// Reads pictures from PNG and JPEG files, for textures. The baker calls it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rendering/material/texture.h"

namespace tactus::host {

// A picture with 8 bits a channel.
struct Image {
  rendering::TextureSize size;
  rendering::TextureFormat format = rendering::TextureFormat::grey;
  // Row by row from the top, each texel with its channels side by side.
  std::vector<std::uint8_t> texels;
};

// Reads a picture. A file without colour gives grey, any other RGB; 16 bits a channel are rounded
// to 8, palettes are looked up, transparency is laid over black. The first bytes decide between PNG
// and JPEG, not the name. Throws InputError that names the file if it cannot be read, is neither of
// the two, is damaged or cut short, or has a side longer than kMaxTextureSide.
Image read_image(const std::filesystem::path& file);

// Returns the picture as grey: unchanged if it is grey, else its luma 0.299 R + 0.587 G + 0.114 B.
Image as_grey(const Image& image);

}  // namespace tactus::host
