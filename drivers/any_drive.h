// Variants over the lists of registered drivers and connections: the settings of any of them,
// their choice by name, and visits together with the registration.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <variant>

#include "drivers/common/must_be.h"
#include "drivers/registered_drivers.h"

namespace tactus::drivers {

namespace detail {

template <class... Registrations>
std::variant<typename Registrations::Config...> any_config(
    const std::tuple<Registrations...>& drivers);
template <class... Registrations>
std::variant<typename Registrations::Connection...> any_connection(
    const std::tuple<Registrations...>& connections);

template <class Config, std::size_t kPlace = 0>
constexpr const auto& driver_of() {
  constexpr const auto& kDriver = std::get<kPlace>(kRegisteredDrivers);
  if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(kDriver)>::Config, Config>) {
    return kDriver;
  } else {
    return driver_of<Config, kPlace + 1>();
  }
}

template <class Connection, std::size_t kPlace = 0>
constexpr const auto& connection_of() {
  constexpr const auto& kKind = std::get<kPlace>(kRegisteredConnections);
  if constexpr (std::is_same_v<typename std::remove_cvref_t<decltype(kKind)>::Connection,
                               Connection>) {
    return kKind;
  } else {
    return connection_of<Connection, kPlace + 1>();
  }
}

}  // namespace detail

// The settings of one axis, by its driver.
using AnyDrive = decltype(detail::any_config(kRegisteredDrivers));
// A connection of any kind.
using AnyConnection = decltype(detail::any_connection(kRegisteredConnections));

// Returns action(registration, settings) for the driver whose settings `drive` holds.
template <class Drive, class Action>
decltype(auto) visit_drive(Drive& drive, Action&& action) {
  return std::visit(
      [&action](auto& config) -> decltype(auto) {
        return action(detail::driver_of<std::remove_cvref_t<decltype(config)>>(), config);
      },
      drive);
}

// Returns action(registration, settings) for the kind of the connection.
template <class Connection, class Action>
decltype(auto) visit_connection(Connection& connection, Action&& action) {
  return std::visit(
      [&action](auto& line) -> decltype(auto) {
        return action(detail::connection_of<std::remove_cvref_t<decltype(line)>>(), line);
      },
      connection);
}

// Sets `drive` to the default settings of the driver with that name. Returns false if there is
// none.
inline bool choose_drive(AnyDrive& drive, std::string_view name) {
  const auto chosen = [&]<class Driver>(const Driver& driver) {
    if (driver.name != name) {
      return false;
    }
    drive.emplace<typename Driver::Config>();
    return true;
  };
  return std::apply([&](const auto&... drivers) { return (chosen(drivers) || ...); },
                    kRegisteredDrivers);
}

// Sets `connection` to the default settings of that kind. Returns false if there is none.
inline bool choose_connection(AnyConnection& connection, std::string_view kind) {
  const auto chosen = [&]<class Kind>(const Kind& known) {
    if (known.kind != kind) {
      return false;
    }
    connection.emplace<typename Kind::Connection>();
    return true;
  };
  return std::apply([&](const auto&... kinds) { return (chosen(kinds) || ...); },
                    kRegisteredConnections);
}

// The rules of both names: must be "one", "another" or "a third".
inline constexpr MustBe kDriverRule{std::apply(
    [](const auto&... drivers) {
      return std::array<std::string_view, sizeof...(drivers)>{drivers.name...};
    },
    kRegisteredDrivers)};
inline constexpr MustBe kConnectionRule{std::apply(
    [](const auto&... kinds) {
      return std::array<std::string_view, sizeof...(kinds)>{kinds.kind...};
    },
    kRegisteredConnections)};

// A drive on CAN has every function of CanFacts but check_bus, or the checks of a bus would miss
// it.
static_assert(std::apply(
    []<class... Drivers>(const Drivers&... drivers) {
      return ((std::is_void_v<typename Drivers::Drive> ||
               (!drivers.can.number_key.empty() && drivers.can.have_same_number != nullptr &&
                drivers.can.claim != nullptr && drivers.can.load != nullptr)) &&
              ...);
    },
    kRegisteredDrivers));
static_assert(std::apply(
    [](const auto&... drivers) {
      return ((!drivers.name.empty() && drivers.keys != nullptr && drivers.check != nullptr) &&
              ...);
    },
    kRegisteredDrivers));

}  // namespace tactus::drivers
