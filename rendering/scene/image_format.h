// The frame around a scene image: a 64-byte header, then one FlatBuffers payload (scene.fbs). All
// numbers are little-endian. Baking (host_tools/bake/scene/image_writer.h) writes it, SceneImage
// reads it.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

namespace tactus::rendering {

static_assert(std::endian::native == std::endian::little, "scene images are used in place");

// The line end in the magic number shows a file that went through a text-mode transfer.
inline constexpr std::array<char, 8> kImageMagic{'T', 'A', 'C', 'T', 'U', 'S', '\r', '\n'};

// The version of the format. Every change that an older controller may not ignore raises it.
inline constexpr std::uint32_t kFormatVersion = 4;

// The alignment that SceneImage::open requires of the first byte. Baking places node pairs so that
// one pair fills one 64-byte cache line if the image starts at a multiple of 64, as a mapped file
// does.
inline constexpr std::size_t kImageAlignment = 16;
inline constexpr std::size_t kCacheLine = 64;

// FlatBuffers offsets are signed 32-bit numbers.
inline constexpr std::uint64_t kMaxPayloadBytes = 0x7fffffff;

// The first 64 bytes of an image.
struct ImageHeader {
  std::array<char, 8> magic = kImageMagic;
  std::uint32_t version = kFormatVersion;
  std::uint32_t reserved = 0;
  // The bytes that follow the header.
  std::uint64_t payload_bytes = 0;
  // These bytes are zero.
  std::array<std::uint64_t, 4> reserved_for_later{};
  // The image_checksum of everything before it and of the payload.
  std::uint64_t checksum = 0;
};
static_assert(sizeof(ImageHeader) == kCacheLine);

// Returns the XXH3 checksum (64 bits) of the payload, seeded with that of the header's bytes before
// the checksum, so that one number guards both. It guards against accidents, not against intent.
std::uint64_t image_checksum(const ImageHeader& header, std::span<const std::byte> payload);

// Returns the checksum that stands in the header of an image, without computing it anew; 0 if the
// bytes are fewer than a header.
std::uint64_t header_checksum(std::span<const std::byte> image);

}  // namespace tactus::rendering
