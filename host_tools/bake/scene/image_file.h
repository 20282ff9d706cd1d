// Pictures from PNG and JPEG files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "rendering/material/texture.h"

namespace tactus::host {

// 8 bits a channel, rows from the top.
struct Image {
  rendering::TextureSize size;
  rendering::TextureFormat format = rendering::TextureFormat::grey;
  std::vector<std::uint8_t> texels;
};

// A file without colour comes as grey, any other as RGB. 16 bits a channel are rounded to 8,
// palettes looked up, transparency laid over black. The kind is told by the file's first bytes, not
// by its name. Throws InputError, naming the file, if it cannot be read, is neither PNG nor JPEG,
// is damaged or cut short, or a side exceeds kMaxTextureSide.
Image read_image(const std::filesystem::path& file);

// The same picture as grey: itself, or its luma (0.299 R + 0.587 G + 0.114 B).
Image as_grey(const Image& image);

}  // namespace tactus::host
