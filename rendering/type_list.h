// Lists of types that implement the same thing, such as the friction models, and calls by number.
//
// A list's order gives the numbers under which its members are stored, so new members go to the
// end. A call by number is a chain of comparisons, which the compiler turns into a switch: there is
// no table of function pointers and no virtual call.
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <variant>

namespace tactus {

template <class... Members>
struct TypeList {
  static constexpr std::size_t kSize = sizeof...(Members);

  using Variant = std::variant<Members...>;

  // Returns an array of what `describe` makes of each member: describe(std::type_identity<T>{}).
  template <class Describe>
  static constexpr auto map(const Describe& describe) {
    return std::array{describe(std::type_identity<Members>{})...};
  }

  // Returns the number of a member.
  template <class Member>
  static constexpr std::size_t number_of() {
    constexpr std::array kIsMember{std::is_same_v<Member, Members>...};
    for (std::size_t i = 0; i < kSize; ++i) {
      if (kIsMember[i]) {
        return i;
      }
    }
    static_assert((std::is_same_v<Member, Members> || ...), "the list has no such member");
    return kSize;
  }
};

// Calls `visitor` with std::type_identity of the member of that number, and returns its result. A
// number beyond the list stands for the last member.
template <class First, class... Rest, class Visitor>
constexpr decltype(auto) visit_number(TypeList<First, Rest...> /*list*/, std::size_t number,
                                      const Visitor& visitor) {
  if constexpr (sizeof...(Rest) == 0) {
    return visitor(std::type_identity<First>{});
  } else {
    return number == 0 ? visitor(std::type_identity<First>{})
                       : visit_number(TypeList<Rest...>{}, number - 1, visitor);
  }
}

// Calls `visitor` with the variant's alternative: std::visit without its exception. The variant
// must not be valueless, which takes an exception.
template <std::size_t kIndex = 0, class Variant, class Visitor>
constexpr decltype(auto) visit_alternative(Variant& variant, const Visitor& visitor) {
  auto* const alternative = std::get_if<kIndex>(&variant);
  if constexpr (kIndex + 1 == std::variant_size_v<std::remove_const_t<Variant>>) {
    if (alternative == nullptr) {
      std::unreachable();
    }
    return visitor(*alternative);
  } else {
    return alternative != nullptr ? visitor(*alternative)
                                  : visit_alternative<kIndex + 1>(variant, visitor);
  }
}

}  // namespace tactus
