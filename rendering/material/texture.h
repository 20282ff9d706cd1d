// A picture on a surface, in ever coarser copies, looked up so that it does not alias: at the speed
// at which the tool crosses it, no detail is left that the tick rate could not carry.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>

#include "rendering/geometry/vector.h"
#include "rendering/limits.h"

namespace tactus::rendering {

enum class TextureFormat : std::uint8_t { grey = 1, rgb = 3 };  // bytes a texel

struct TextureSize {
  std::uint32_t width = 1;
  std::uint32_t height = 1;

  bool operator==(const TextureSize&) const = default;
};

// The size of the next coarser level: half, rounded down, at least 1.
constexpr TextureSize coarser(TextureSize size) {
  return {size.width > 1 ? size.width / 2 : 1, size.height > 1 ? size.height / 2 : 1};
}

// Bytes of all levels down to 1 x 1, finest first, rows from the top, without gaps.
std::size_t pyramid_bytes(TextureSize size, TextureFormat format);

// A view of the bytes of a pyramid, which the caller keeps alive and unchanged.
class TextureView {
 public:
  // Returns the view, or nothing if a side is 0 or above kMaxTextureSide, or `bytes` are not
  // pyramid_bytes().
  static std::optional<TextureView> open(std::span<const std::uint8_t> bytes, TextureSize size,
                                         TextureFormat format);

  [[nodiscard]] TextureFormat format() const { return format_; }
  [[nodiscard]] std::size_t levels() const { return level_count_; }
  [[nodiscard]] TextureSize size(std::size_t level = 0) const { return levels_[level].size; }

  // Texel of column x and row y, from 0 to 1; a grey one is the same three times.
  [[nodiscard]] Vec3 texel(std::size_t level, std::uint32_t x, std::uint32_t y) const;

 private:
  struct Level {
    TextureSize size;
    std::size_t first = 0;  // byte
  };

  TextureView() = default;

  std::span<const std::uint8_t> bytes_;
  std::array<Level, kMaxTextureLevels> levels_{};
  std::size_t level_count_ = 0;
  TextureFormat format_ = TextureFormat::grey;
};

// A place in a picture: 0 to 1 from the left to the right and from the bottom to the top; beyond,
// the picture repeats. Finite, |u| and |v| below 2^31.
struct TexturePoint {
  double u = 0.0;
  double v = 0.0;
};

// The level, between 0 and levels() - 1, at which a tool that moves `travel_m` from tick to tick
// meets no detail beyond half the tick rate (the straight lines between texels leave up to 6
// percent of a wave as overtones); `texel_m` > 0 is the size of a texel of level 0 on the surface,
// the smaller side. Between octaves it grows linearly.
double mip_level(const TextureView& texture, double travel_m, double texel_m);

// Bilinear within levels, linear between them. Continuous in everything. `level` as of mip_level.
Vec3 look_up(const TextureView& texture, const TexturePoint& at, double level);

struct TextureSlope {
  double per_u = 0.0;
  double per_v = 0.0;
};

// Returns the slope of channel 0 along u and v, over a texel's width of the levels in use. It is
// exact where the picture is a plane, and continuous.
TextureSlope slope(const TextureView& texture, const TexturePoint& at, double level);

}  // namespace tactus::rendering
