#include "firmware/device_file/certificate_words.h"

#include <algorithm>
#include <cstdarg>
#include <cstdio>

namespace tactus::firmware {

namespace {

// Puts words behind each other in a room, cut at its end.
class Sentence {
 public:
  explicit Sentence(std::span<char> room) : room_(room) {}

  [[gnu::format(printf, 2, 0)]] void add_values(const char* format, std::va_list values) {
    const std::span<char> rest = room_.subspan(size_);
    const int wanted = std::vsnprintf(rest.data(), rest.size(), format, values);
    const std::size_t most = rest.empty() ? 0 : rest.size() - 1;
    size_ += std::min(static_cast<std::size_t>(std::max(wanted, 0)), most);
  }

  [[gnu::format(printf, 2, 3)]] void add(const char* format, ...) {
    std::va_list values;
    va_start(values, format);
    add_values(format, values);
    va_end(values);
  }

  [[nodiscard]] std::string_view words() const { return {room_.data(), size_}; }

 private:
  std::span<char> room_;
  std::size_t size_ = 0;
};

[[gnu::format(printf, 2, 3)]] std::string_view write_words(std::span<char> room, const char* format,
                                                           ...) {
  Sentence sentence(room);
  std::va_list values;
  va_start(values, format);
  sentence.add_values(format, values);
  va_end(values);
  return sentence.words();
}

using Kind = UncertifiedPart::Kind;

void add_part(Sentence& sentence, Kind kind, std::size_t index, const std::array<char, 64>& name) {
  if (kind == Kind::wall) {
    constexpr std::string_view kAxes = "xyz";
    sentence.add("the workspace's %s wall across %c", index % 2 == 0 ? "lower" : "upper",
                 kAxes[std::min<std::size_t>(index / 2, kAxes.size() - 1)]);
  } else if (kind == Kind::object && name.front() != '\0') {
    sentence.add("object '%s'", name.data());
  } else {
    sentence.add("%s %zu", kind == Kind::object ? "object" : "effect", index + 1);
  }
}

void add_parts(Sentence& sentence, const UncertifiedPart& part, const PartNames& names) {
  add_part(sentence, part.kind, part.index, names[0]);
  const std::size_t listed = std::min(part.listed, part.others.size());
  const std::size_t unlisted = part.other_count - listed;
  for (std::size_t i = 0; i < listed; ++i) {
    sentence.add("%s", i + 1 == listed && unlisted == 0 ? " and " : ", ");
    add_part(sentence, part.others[i].kind, part.others[i].index, names[i + 1]);
  }
  if (unlisted > 0) {
    sentence.add(" and %zu more", unlisted);
  }
}

bool is_at_wall(const UncertifiedPart& part) {
  const auto others = std::span(part.others).first(std::min(part.listed, part.others.size()));
  return std::ranges::any_of(
      others, [](const UncertifiedPart::Other& other) { return other.kind == Kind::wall; });
}

// Returns the remedy in the scene.
const char* remedy_for(const UncertifiedPart& part) {
  if (part.kind == Kind::wall) {
    return "lower workspace_stiffness_N_per_m and workspace_damping_Ns_per_m";
  }
  if (is_at_wall(part)) {
    return "soften what is not a wall of the workspace or move it away from there, lower "
           "workspace_stiffness_N_per_m";
  }
  return part.other_count == 0 ? "soften it" : "soften one of them or move them apart";
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

PartNames names_of(const UncertifiedPart& part, const rendering::SceneImage& scene) {
  PartNames names{};
  const auto put = [&](std::size_t place, Kind kind, std::size_t index) {
    if (kind == Kind::object && index < scene.objects().size()) {
      const std::string_view name = scene.object_name(index);
      std::ranges::copy(name.substr(0, names[place].size() - 1), names[place].begin());
    }
  };
  put(0, part.kind, part.index);
  for (std::size_t i = 0; i < std::min(part.listed, part.others.size()); ++i) {
    put(i + 1, part.others[i].kind, part.others[i].index);
  }
  return names;
}

std::string_view uncertified_words(const UncertifiedPart& part, const PartNames& names,
                                   std::span<char> room) {
  const bool alone = part.other_count == 0;
  Sentence sentence(room);
  add_parts(sentence, part, names);
  sentence.add(alone ? " has" : " are felt in one place and together have");
  if (part.damping_Ns_per_m > part.most_damping_Ns_per_m) {
    sentence.add(" a damping of %g N s/m, and the device is certified up to %g N s/m",
                 part.damping_Ns_per_m, part.most_damping_Ns_per_m);
  } else {
    sentence.add(
        " a stiffness of %g N/m, and the device is certified up to %.0f N/m with a "
        "damping of %g N s/m",
        part.stiffness_N_per_m, part.limit_N_per_m, part.damping_Ns_per_m);
  }
  sentence.add(
      "; %s, certify a stiffer device with tactus certify, or take the risk with "
      "--allow-uncertified",
      remedy_for(part));
  return sentence.words();
}

std::string_view refusal_words(const SceneRefusal& refusal, const PartNames& names,
                               std::span<char> room) {
  switch (refusal.fault) {
    case SceneFault::uncertified:
      return uncertified_words(refusal.part, names, room);
    case SceneFault::active:
      return write_words(room, "no scene can be loaded while the motors are on; disable first");
    case SceneFault::costly:
      return write_words(
          room,
          "the objects that move or deform and the effects take %.0f of the %.0f instructions of a "
          "tick, and contacts need half of them; let fewer move, simplify the meshes that deform, "
          "lower the rate or raise tick_instructions in the device's [controller]",
          rendering::instructions_of(refusal.standing_units),
          rendering::instructions_of(refusal.budget_units));
    case SceneFault::capacity:
      return rendering::exceeded_words(refusal.exceeded, room);
    case SceneFault::world:
      break;
  }
  return write_words(room, "the controller cannot use this scene; bake it again with this version");
}

}  // namespace tactus::firmware
