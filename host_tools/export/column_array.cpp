#include "host_tools/export/column_array.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <type_traits>
#include <variant>

namespace tactus::host {

static_assert(std::endian::native == std::endian::little, "the arrays are little-endian");

void ColumnArray::append(const ColumnValue& value) {
  std::visit(
      [&](const auto& each) {
        using Value = std::remove_cvref_t<decltype(each)>;
        if constexpr (std::is_same_v<Value, std::string_view>) {
          words_.push_back(each);
          longest_word_ = std::max(longest_word_, each.size());
        } else if constexpr (std::is_same_v<Value, HashValue>) {
          number_type_ = "<u8";
          numbers_.push_back(each.hash);
        } else {
          number_type_ = std::is_same_v<Value, double>         ? "<f8"
                         : std::is_same_v<Value, std::int64_t> ? "<i8"
                                                               : "<u8";
          numbers_.push_back(std::bit_cast<std::uint64_t>(each));
        }
      },
      value);
}

std::string ColumnArray::type() const {
  return has_words() ? fmt::format("<U{}", longest_word_) : std::string(number_type_);
}

std::size_t ColumnArray::value_bytes() const {
  return has_words() ? longest_word_ * sizeof(char32_t) : sizeof(std::uint64_t);
}

std::vector<char32_t> ColumnArray::text(std::size_t index) const {
  std::vector<char32_t> characters(longest_word_, U'\0');
  std::ranges::transform(words_[index], characters.begin(), [](char each) {
    return static_cast<char32_t>(static_cast<unsigned char>(each));
  });
  return characters;
}

}  // namespace tactus::host
