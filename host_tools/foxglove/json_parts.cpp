#include "host_tools/foxglove/json_parts.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

namespace tactus::host {
namespace {

double finite(double value) {
  return std::isfinite(value) ? value : 0.0;
}

}  // namespace

std::string time_json(std::uint64_t time_ns) {
  constexpr std::uint64_t kNsPerSecond = 1'000'000'000;
  return fmt::format(R"({{"sec":{},"nsec":{}}})", time_ns / kNsPerSecond, time_ns % kNsPerSecond);
}

std::string vector_json(const firmware::Triple& v) {
  return fmt::format(R"({{"x":{:.9g},"y":{:.9g},"z":{:.9g}}})", finite(v[0]), finite(v[1]),
                     finite(v[2]));
}

std::string rotation_json(const firmware::Quadruple& rotation) {
  const auto& [w, x, y, z] = rotation;
  return fmt::format(R"({{"x":{:.9g},"y":{:.9g},"z":{:.9g},"w":{:.9g}}})", finite(x), finite(y),
                     finite(z), finite(w));
}

std::string pose_json(const firmware::Triple& position, const firmware::Quadruple& rotation) {
  return fmt::format(R"({{"position":{},"orientation":{}}})", vector_json(position),
                     rotation_json(rotation));
}

std::string text_json(std::string_view text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tactus::host
