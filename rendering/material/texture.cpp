#include "rendering/material/texture.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace tactus::rendering {
namespace {

// Returns log2 of x > 0, exact at powers of two and linear between them: at most 0.086 too low. It
// is read off the double's exponent and mantissa.
double even_log2(double x) {
  constexpr int kDoubleMantissaBits = 52;
  constexpr int kDoubleBias = 1023;
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const int exponent = static_cast<int>(bits >> kDoubleMantissaBits) - kDoubleBias;
  const auto mantissa =
      std::bit_cast<double>((bits & ((std::uint64_t{1} << kDoubleMantissaBits) - 1)) |
                            (static_cast<std::uint64_t>(kDoubleBias) << kDoubleMantissaBits));
  return exponent + (mantissa - 1.0);
}

// The two texels beside a place along one side, and the share of the way from the first to the
// second.
struct Beside {
  std::uint32_t first;
  std::uint32_t second;
  double share;
};

// Texel i has its centre at (i + 0.5) / count. The picture repeats, so the last is beside the
// first.
Beside beside(double at, std::uint32_t count) {
  const double scaled = (at - std::floor(at)) * count - 0.5;
  const double low = std::floor(scaled);
  const auto last = count - 1;
  const std::uint32_t first = low < 0.0 ? last : std::min(static_cast<std::uint32_t>(low), last);
  return {first, first == last ? 0 : first + 1, scaled - low};
}

// Returns the colour within one level.
Vec3 bilinear(const TextureView& texture, const TexturePoint& at, std::size_t level) {
  const TextureSize size = texture.size(level);
  const Beside x = beside(at.u, size.width);
  const Beside y = beside(-at.v, size.height);  // rows count from the top
  const auto row = [&](std::uint32_t r) {
    const Vec3 left = texture.texel(level, x.first, r);
    return Vec3{left + x.share * (texture.texel(level, x.second, r) - left)};
  };
  const Vec3 upper = row(y.first);
  return upper + y.share * (row(y.second) - upper);
}

// Returns value(level) between the two levels next to `level`.
template <class Value>
auto between_levels(const TextureView& texture, double level, const Value& value) {
  const auto last = static_cast<double>(texture.levels() - 1);
  const double clamped = std::clamp(level, 0.0, last);
  const double low = std::floor(clamped);
  const auto fine = static_cast<std::size_t>(low);
  const auto here = value(fine);
  return clamped > low ? decltype(here){here + (clamped - low) * (value(fine + 1) - here)} : here;
}

}  // namespace

std::size_t pyramid_bytes(TextureSize size, TextureFormat format) {
  std::size_t texels = 0;
  for (TextureSize level = size;; level = coarser(level)) {
    texels += std::size_t{level.width} * level.height;
    if (level == TextureSize{}) {
      return texels * static_cast<std::size_t>(format);
    }
  }
}

std::optional<TextureView> TextureView::open(std::span<const std::uint8_t> bytes, TextureSize size,
                                             TextureFormat format) {
  const std::uint32_t shorter = std::min(size.width, size.height);
  const std::uint32_t longer = std::max(size.width, size.height);
  if (shorter == 0 || longer > kMaxTextureSide ||
      (format != TextureFormat::grey && format != TextureFormat::rgb) ||
      bytes.size() != pyramid_bytes(size, format)) {
    return std::nullopt;
  }
  TextureView view;
  view.bytes_ = bytes;
  view.format_ = format;
  std::size_t first = 0;
  for (TextureSize level = size;; level = coarser(level)) {
    view.levels_[view.level_count_++] = {level, first};
    first += std::size_t{level.width} * level.height * static_cast<std::size_t>(format);
    if (level == TextureSize{}) {
      return view;
    }
  }
}

Vec3 TextureView::texel(std::size_t level, std::uint32_t x, std::uint32_t y) const {
  constexpr double kWhite = 255.0;
  const Level& of = levels_[level];
  const std::size_t index = std::size_t{y} * of.size.width + x;
  const std::uint8_t* bytes = &bytes_[of.first + index * static_cast<std::size_t>(format_)];
  if (format_ == TextureFormat::grey) {
    return Vec3::Constant(bytes[0] / kWhite);
  }
  return Vec3(bytes[0], bytes[1], bytes[2]) / kWhite;
}

// A level with texels of the size T holds no waves shorter than 2 T
// (host_tools/bake/scene/mip_pyramid.h), and a tick rate carries none shorter than two ticks'
// travel: so T has to be a tick's travel at least. The finer of the two levels in use is up to an
// octave finer than asked for, hence the 2.
double mip_level(const TextureView& texture, double travel_m, double texel_m) {
  const double texels = 2.0 * travel_m / texel_m;
  if (!(texels > 1.0)) {
    return 0.0;
  }
  return std::min(even_log2(texels), static_cast<double>(texture.levels() - 1));
}

Vec3 look_up(const TextureView& texture, const TexturePoint& at, double level) {
  return between_levels(texture, level, [&](std::size_t k) { return bilinear(texture, at, k); });
}

// Central differences over half a texel to either side, which bilinear lookup makes continuous.
TextureSlope slope(const TextureView& texture, const TexturePoint& at, double level) {
  const auto difference = [&](std::size_t k) {
    const TextureSize size = texture.size(k);
    const double half_u = 0.5 / size.width;
    const double half_v = 0.5 / size.height;
    const double right = bilinear(texture, {at.u + half_u, at.v}, k).x();
    const double left = bilinear(texture, {at.u - half_u, at.v}, k).x();
    const double above = bilinear(texture, {at.u, at.v + half_v}, k).x();
    const double below = bilinear(texture, {at.u, at.v - half_v}, k).x();
    return Eigen::Vector2d((right - left) * size.width, (above - below) * size.height);
  };
  const Eigen::Vector2d both = between_levels(texture, level, difference);
  return {.per_u = both.x(), .per_v = both.y()};
}

}  // namespace tactus::rendering
