#include "firmware/device_file/device_certificate.h"

#include <algorithm>
#include <bit>

#include "firmware/device_file/device_commissioning.h"

namespace tactus::firmware {

namespace {

std::unexpected<DeviceError> refuse_certificate(std::size_t section, std::string_view key,
                                                std::string_view what) {
  return std::unexpected(DeviceError{what, section, key});
}

class Fnv1a {
 public:
  void add(std::uint8_t byte) {
    constexpr std::uint64_t kPrime = 0x100000001b3;
    hash_ = (hash_ ^ byte) * kPrime;
  }
  void add(std::string_view text) {
    for (const char c : text) {
      add(static_cast<std::uint8_t>(c));
    }
    add(std::uint8_t{0});
  }
  void add(double number) {
    const auto bits = std::bit_cast<std::uint64_t>(number);
    for (unsigned shift = 0; shift < 64; shift += 8) {
      add(static_cast<std::uint8_t>(bits >> shift));
    }
  }
  [[nodiscard]] std::uint64_t hash() const { return hash_; }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

std::uint64_t hash_of(const Setting& setting) {
  Fnv1a hash;
  hash.add(setting.key);
  hash.add(static_cast<std::uint8_t>(setting.type));
  hash.add(setting.text);
  for (const double number : setting.numbers) {
    hash.add(number);
  }
  return hash.hash();
}

bool is_written_by_people(const DeviceSection& section) {
  return section.kind != kCertificateKind && section.kind != kCommissioningKind;
}

bool touches_stability(const DeviceSection& section) {
  return is_written_by_people(section) && section.kind != "connection";
}

// Returns a hash that does not depend on the order of the settings.
std::uint64_t hash_of(const DeviceSection& section) {
  std::uint64_t sum = 0;
  for (const Setting& setting : section.all()) {
    const bool is_name = section.kind == "device" && setting.key == "name";
    sum += is_name ? 0 : hash_of(setting);
  }
  return sum;
}

std::uint64_t checksum_of(const DeviceSections& sections, bool (*counts)(const DeviceSection&)) {
  Fnv1a hash;
  for (const DeviceSection& section : sections.all()) {
    if (counts(section)) {
      hash.add(section.kind);
      hash.add(std::bit_cast<double>(hash_of(section)));
    }
  }
  return hash.hash();
}

const Setting* find(const DeviceSection& section, std::string_view key) {
  const auto all = section.all();
  const auto found = std::ranges::find(all, key, &Setting::key);
  return found == all.end() ? nullptr : &*found;
}

bool has_type(const Setting* setting, SettingType type) {
  return setting != nullptr && setting->type == type;
}

// Returns an error for the first key that is missing, unknown or of the wrong type.
std::expected<void, DeviceError> check_keys(const DeviceSection& section, std::size_t index) {
  constexpr std::array<std::pair<std::string_view, SettingType>, 5> kKeys = {
      {{kCertificateDampings, SettingType::numbers},
       {kCertificateStiffnesses, SettingType::numbers},
       {kCertificateMargin, SettingType::number},
       {kCertificateMethod, SettingType::text},
       {kCertificateSettings, SettingType::text}}};
  for (const auto& [key, type] : kKeys) {
    if (!has_type(find(section, key), type)) {
      return refuse_certificate(index, key,
                                "is missing or of another type; run tactus certify again");
    }
  }
  for (const Setting& setting : section.all()) {
    if (std::ranges::find(kKeys, setting.key, &decltype(kKeys)::value_type::first) == kKeys.end()) {
      return refuse_certificate(index, setting.key, "unknown key");
    }
  }
  return {};
}

}  // namespace

std::uint64_t settings_checksum(const DeviceSections& sections) {
  return checksum_of(sections, touches_stability);
}

std::uint64_t all_settings_checksum(const DeviceSections& sections) {
  return checksum_of(sections, is_written_by_people);
}

ChecksumText checksum_text(std::uint64_t checksum) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  ChecksumText text;
  for (char& digit : text.digits) {
    digit = kDigits[static_cast<std::size_t>(checksum >> 60U)];
    checksum <<= 4U;
  }
  return text;
}

std::expected<Certification, DeviceError> read_certificate(const DeviceSections& sections,
                                                           std::size_t index) {
  const DeviceSection& section = sections.sections[index];
  if (const auto checked = check_keys(section, index); !checked) {
    return std::unexpected(checked.error());
  }
  const auto dampings = find(section, kCertificateDampings)->numbers;
  const auto stiffnesses = find(section, kCertificateStiffnesses)->numbers;
  if (dampings.empty() || dampings.size() > kMaxCertifiedPoints ||
      dampings.size() != stiffnesses.size()) {
    return refuse_certificate(index, kCertificateStiffnesses,
                              "must be 1 to 16 numbers, one a damping");
  }
  Certification certification{.is_there = true,
                              .measured_with = find(section, kCertificateMethod)->text};
  certification.is_for_these_settings = find(section, kCertificateSettings)->text ==
                                        checksum_text(settings_checksum(sections)).view();
  if (certification.is_for_these_settings) {
    StiffnessCertificate& limits = certification.limits;
    limits.margin = find(section, kCertificateMargin)->numbers[0];
    limits.count = dampings.size();
    for (std::size_t i = 0; i < dampings.size(); ++i) {
      limits.points[i] = {.damping_Ns_per_m = dampings[i], .stiffness_N_per_m = stiffnesses[i]};
    }
  }
  return certification;
}

}  // namespace tactus::firmware
