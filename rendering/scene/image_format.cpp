#include "rendering/scene/image_format.h"

// The whole hash in this file: a bare-metal build has the header but not the library.
#define XXH_INLINE_ALL
#include <xxhash.h>

#include <cstring>

namespace tactus::rendering {

std::uint64_t image_checksum(const ImageHeader& header, std::span<const std::byte> payload) {
  const std::uint64_t seed = XXH3_64bits(&header, offsetof(ImageHeader, checksum));
  return XXH3_64bits_withSeed(payload.data(), payload.size(), seed);
}

std::uint64_t header_checksum(std::span<const std::byte> image) {
  ImageHeader header;
  if (image.size() < sizeof header) {
    return 0;
  }
  std::memcpy(&header, image.data(), sizeof header);
  return header.checksum;
}

}  // namespace tactus::rendering
