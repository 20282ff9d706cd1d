#include "firmware/device/certificate_words.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace tactus::firmware {

namespace {

[[gnu::format(printf, 2, 3)]] std::string_view write_words(std::span<char> room, const char* format,
                                                           ...) {
  std::va_list values;
  va_start(values, format);
  const int wanted = std::vsnprintf(room.data(), room.size(), format, values);
  va_end(values);
  const std::size_t most = room.empty() ? 0 : room.size() - 1;
  return {room.data(), std::min(static_cast<std::size_t>(std::max(wanted, 0)), most)};
}

std::string_view uncertified_words(const UncertifiedPart& part, std::string_view name,
                                   std::span<char> room) {
  const bool is_object = part.kind == UncertifiedPart::Kind::object;
  std::array<char, 96> what{};
  const std::string_view named =
      is_object && !name.empty()
          ? write_words(what, "object '%.*s'", static_cast<int>(name.size()), name.data())
          : write_words(what, "%s %zu", is_object ? "object" : "effect", part.index + 1);
  constexpr const char* kRemedy =
      "soften it, certify a stiffer device with tactus certify, or take the risk with "
      "--allow-uncertified";
  if (part.damping_Ns_per_m > part.most_damping_Ns_per_m) {
    return write_words(
        room,
        "%.*s has a damping of %g N s/m, and the device is certified up to %g N s/m; "
        "%s",
        static_cast<int>(named.size()), named.data(), part.damping_Ns_per_m,
        part.most_damping_Ns_per_m, kRemedy);
  }
  return write_words(room,
                     "%.*s has a stiffness of %g N/m, and the device is certified up to %.0f N/m "
                     "with a damping of %g N s/m; %s",
                     static_cast<int>(named.size()), named.data(), part.stiffness_N_per_m,
                     part.limit_N_per_m, part.damping_Ns_per_m, kRemedy);
}

}  // namespace

std::string_view certificate_warning(const Certification& certification, std::span<char> room) {
  if (!certification.is_there) {
    return write_words(room,
                       "the device has no certificate, so stiff surfaces are not refused; make one "
                       "with: tactus certify device.toml");
  }
  if (!certification.is_for_these_settings) {
    return write_words(room,
                       "the device's certificate is void, because its settings have been changed; "
                       "make a new one with: tactus certify device.toml");
  }
  return {};
}

std::string_view refusal_words(const SceneRefusal& refusal, std::string_view name,
                               std::span<char> room) {
  switch (refusal.fault) {
    case SceneFault::uncertified:
      return uncertified_words(refusal.part, name, room);
    case SceneFault::active:
      return write_words(room, "no scene can be loaded while the motors are on; disable first");
    case SceneFault::world:
      break;
  }
  return write_words(room, "the controller has no room for this scene");
}

}  // namespace tactus::firmware
