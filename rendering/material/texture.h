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

// The format of a picture; its value is the bytes a texel.
enum class TextureFormat : std::uint8_t { grey = 1, rgb = 3 };  // bytes a texel

// The texels along the sides of a level.
struct TextureSize {
  std::uint32_t width = 1;
  std::uint32_t height = 1;

  bool operator==(const TextureSize&) const = default;
};

// Returns the size of the next coarser level: half, rounded down, at least 1.
constexpr TextureSize coarser(TextureSize size) {
  return {size.width > 1 ? size.width / 2 : 1, size.height > 1 ? size.height / 2 : 1};
}

// Returns the bytes of all levels down to 1 x 1, finest first, rows from the top, without gaps.
std::size_t pyramid_bytes(TextureSize size, TextureFormat format);

// A view of the bytes of a pyramid, which the caller keeps alive and unchanged.
class TextureView {
 public:
  // Returns the view, or nothing if a side is 0 or above kMaxTextureSide, or `bytes` are not
  // pyramid_bytes().
  static std::optional<TextureView> open(std::span<const std::uint8_t> bytes, TextureSize size,
                                         TextureFormat format);

  // Return the format, the number of levels and the size of a level; level 0 is the finest.
  [[nodiscard]] TextureFormat format() const { return format_; }
  [[nodiscard]] std::size_t levels() const { return level_count_; }
  [[nodiscard]] TextureSize size(std::size_t level = 0) const { return levels_[level].size; }

  // Returns the texel of column x and row y, each channel from 0 to 1; a grey one is the same three
  // times.
  [[nodiscard]] Vec3 texel(std::size_t level, std::uint32_t x, std::uint32_t y) const;

 private:
  struct Level {
    TextureSize size;
    // The first byte of the level.
    std::size_t first = 0;
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

// Returns the level, between 0 and levels() - 1, at which a tool that moves `travel_m` from tick to
// tick meets no detail beyond half the tick rate (the straight lines between texels leave up to 6
// percent of a wave as overtones). `texel_m` > 0 is the size of a texel of level 0 on the surface,
// the smaller side. The level grows linearly between octaves.
double mip_level(const TextureView& texture, double travel_m, double texel_m);

// Returns the colour at a place: bilinear within levels, linear between them, and so continuous in
// everything. `level` is that of mip_level.
Vec3 look_up(const TextureView& texture, const TexturePoint& at, double level);

// The slope of a picture: the change of channel 0 along each side of the whole picture.
struct TextureSlope {
  double per_u = 0.0;
  double per_v = 0.0;
};

// Returns the slope of channel 0 along u and v, over a texel's width of the levels in use. It is
// exact where the picture is a plane, and continuous.
TextureSlope slope(const TextureView& texture, const TexturePoint& at, double level);

}  // namespace tactus::rendering
