#include "drivers/common/words.h"

#include <charconv>

namespace tactus::drivers {

Words& Words::add(double number, int decimals) {
  constexpr double kLargest = 1e9;
  if (std::isnan(number) || std::abs(number) > kLargest) {
    return add(number < 0.0 ? "less than -1e9" : "more than 1e9");
  }
  const double scale = std::pow(10.0, decimals);
  const auto scaled = static_cast<std::uint64_t>(std::llround(std::abs(number) * scale));
  const auto unit = static_cast<std::uint64_t>(scale);
  add(number < 0.0 && scaled != 0 ? "-" : "").add(static_cast<std::uint32_t>(scaled / unit));
  std::uint64_t rest = scaled % unit;
  if (rest == 0) {
    return *this;
  }
  add(".");
  for (std::uint64_t place = unit / 10; rest != 0; place /= 10) {
    add(static_cast<std::uint32_t>(rest / place));
    rest %= place;
  }
  return *this;
}

Words& Words::add(std::uint32_t number, std::uint32_t base) {
  std::array<char, 32> digits{};
  const auto [end, error] =
      std::to_chars(digits.data(), digits.data() + digits.size(), number, static_cast<int>(base));
  return error == std::errc{} ? add({digits.data(), static_cast<std::size_t>(end - digits.data())})
                              : *this;
}

}  // namespace tactus::drivers
