// A board for drives of any registered kind on one CAN bus.
#pragma once

#include <tuple>
#include <type_traits>

#include "drivers/composition/can_board.h"
#include "drivers/registered_drivers.h"

namespace tactus::drivers {

namespace detail {

template <class Driver>
using DrivesOf = std::conditional_t<std::is_void_v<typename Driver::Drive>, std::tuple<>,
                                    std::tuple<std::type_identity<typename Driver::Drive>>>;

template <class... Drivers>
auto drives_on_can(const std::tuple<Drivers...>& /*drivers*/) {
  return std::tuple_cat(DrivesOf<Drivers>{}...);
}

template <class... Drives>
CanBoard<Drives...> board_of(const std::tuple<std::type_identity<Drives>...>& drives);

}  // namespace detail

using RegisteredCanBoard = decltype(detail::board_of(detail::drives_on_can(kRegisteredDrivers)));

}  // namespace tactus::drivers
