// The frame around a scene image: a 64-byte header, then one FlatBuffers payload (scene.fbs). All
// numbers are little-endian.
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

// Raised by every change that an older controller may not ignore.
inline constexpr std::uint32_t kFormatVersion = 4;

// The alignment that SceneImage::open requires of the first byte. Baking places node pairs so that
// one pair fills one 64-byte cache line if the image starts at a multiple of 64, as a mapped file
// does.
inline constexpr std::size_t kImageAlignment = 16;
inline constexpr std::size_t kCacheLine = 64;

// FlatBuffers offsets are signed 32-bit numbers.
inline constexpr std::uint64_t kMaxPayloadBytes = 0x7fffffff;

struct ImageHeader {
  std::array<char, 8> magic = kImageMagic;
  std::uint32_t version = kFormatVersion;
  std::uint32_t reserved = 0;
  std::uint64_t payload_bytes = 0;
  std::array<std::uint64_t, 4> reserved_for_later{};
  std::uint64_t checksum = 0;  // image_checksum of everything before it and of the payload
};
static_assert(sizeof(ImageHeader) == kCacheLine);

// XXH3 (64 bits) of the payload, seeded with XXH3 of the header's bytes before the checksum.
std::uint64_t image_checksum(const ImageHeader& header, std::span<const std::byte> payload);

}  // namespace tactus::rendering
