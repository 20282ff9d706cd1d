#include "rendering/contact/tangent_bounds.h"

#include <bit>
#include <cstring>
#include <limits>

namespace tactus::rendering {
namespace {

// Adds one number to each of four 16-bit numbers by multiplication.
constexpr std::uint64_t kInEachOfFour = 0x0001'0001'0001'0001;

// The numbers of the bits that are set in a group of four, ascending, and their count.
struct Numbers {
  std::uint64_t of_each = 0;  // the entries beyond `count` have no meaning
  std::size_t count = 0;
};
// The numbers of set bits for each of the 16 possible answers of four lanes.
constexpr std::array<Numbers, 16> kNumbersOf = [] {
  std::array<Numbers, 16> all{};
  for (std::uint32_t bits = 0; bits < all.size(); ++bits) {
    std::array<std::uint16_t, 4> numbers{};
    std::size_t count = 0;
    for (std::size_t k = 0; k < numbers.size(); ++k) {
      numbers[count] = static_cast<std::uint16_t>(k);
      count += bits >> k & 1U;
    }
    all[bits] = {.of_each = std::bit_cast<std::uint64_t>(numbers), .count = count};
  }
  return all;
}();

}  // namespace

// An infinite height is above every reach.
void TangentBounds::fill_last_four(std::size_t size) {
  for (std::size_t i = size; i % 4 != 0; ++i) {
    normal_x_[i] = normal_y_[i] = normal_z_[i] = 0.0F;
    height_[i] = std::numeric_limits<float>::infinity();
  }
}

void TangentBounds::find(std::size_t size, const Vec3& p, double farther_m,
                         CandidateNumbers& found) const {
  static_assert(kMaxCandidates % 4 == 0);
  const Position here = at(p);
  const Floats reach = rendering::all(here.reach + static_cast<float>(farther_m));
  std::size_t count = 0;
  for (std::size_t first = 0; first < size; first += 4) {
    const Floats bound = aligned_floats_at(&normal_x_[first]) * here.x +
                         aligned_floats_at(&normal_y_[first]) * here.y +
                         aligned_floats_at(&normal_z_[first]) * here.z +
                         aligned_floats_at(&height_[first]);
    // All four numbers are written, and those that are not near are written over by the next ones:
    // a branch would mostly be predicted wrong.
    const Numbers& near = kNumbersOf[which(bound <= reach)];
    const std::uint64_t numbers = near.of_each + first * kInEachOfFour;
    std::memcpy(&found.numbers[count], &numbers, sizeof numbers);
    count += near.count;
  }
  found.count = count;
}

}  // namespace tactus::rendering
