#include "host_tools/bake/device/device_bake.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "firmware/device_file/bus_load.h"
#include "firmware/device_file/device_certificate.h"
#include "firmware/device_file/device_commissioning.h"
#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/device/shaft_checks.h"
#include "host_tools/bake/device/written_sections.h"
#include "host_tools/bake/toml/key_advice.h"
#include "host_tools/bake/toml/toml_file.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Returns the advice for a key that the section does not have.
std::string advice_on(const firmware::DeviceSections& sections, std::size_t section,
                      const WrittenSetting& setting) {
  std::array<firmware::KnownKey, firmware::kMaxSettings> known{};
  const std::size_t count = firmware::known_keys(sections, section, known);
  std::vector<KeySpec> keys;
  for (const firmware::KnownKey& key : std::span(known).first(count)) {
    keys.push_back({key.key, key.unit});
  }
  return advise(setting.key, keys, setting.numbers,
                setting.type == firmware::image::ValueType::numbers);
}

[[noreturn]] void throw_explained(std::span<const WrittenSection> written,
                                  const firmware::DeviceSections& sections,
                                  const firmware::DeviceError& error) {
  const WrittenSection& section = written[std::min(error.section, written.size() - 1)];
  const auto setting = std::ranges::find(section.settings, error.key, &WrittenSetting::key);
  if (setting == section.settings.end()) {
    fail_at(section.file, section.line,
            error.key.empty() ? fmt::format("{}: {}", section.title, error.what)
                              : fmt::format("{}: {} {}", section.title, error.key, error.what));
  }
  if (error.what == "unknown key") {
    fail_at(section.file, setting->line,
            fmt::format("{}: unknown key '{}'; {}", section.title, setting->key,
                        advice_on(sections, error.section, *setting)));
  }
  fail_at(section.file, setting->line,
          fmt::format("{}: {} {}", section.title, error.key, error.what));
}

// Bytes that the controller would take.
std::vector<std::byte> write_checked(std::span<const WrittenSection> written) {
  std::vector<std::byte> bytes = image_of(written);
  firmware::DeviceSections sections;
  firmware::DeviceConfig config;
  auto outcome = firmware::open_device_image(bytes, sections);
  if (outcome) {
    outcome = firmware::read_device(sections, config);
  }
  if (!outcome) {
    throw_explained(written, sections, outcome.error());
  }
  return bytes;
}

// A result that a tool measured on a device and wrote into a file beside the device's.
struct FoundOut {
  std::string_view kind;
  std::string_view verb;
  std::filesystem::path (*path)(const std::filesystem::path& device);
  std::string_view without_it;
};
constexpr std::array<FoundOut, 2> kFoundOut = {
    {{firmware::kCertificateKind, "certify", certificate_path,
      "without a certificate, so tactusd will not refuse surfaces that are too stiff"},
     {firmware::kCommissioningKind, "commission", commissioning_path,
      "not commissioned, so tactusd will not enable it"}}};

std::vector<WrittenSection> read_device_file(const std::string& name) {
  std::vector<WrittenSection> written = read_sections(name, parse_toml(read_file(name), name));
  for (const FoundOut& found_out : kFoundOut) {
    const auto section = std::ranges::find(written, found_out.kind, &WrittenSection::kind);
    if (section != written.end()) {
      fail_at(name, section->line,
              fmt::format("[{}]: stands in a file of its own, which tactus {} writes; remove this "
                          "table",
                          found_out.kind, found_out.verb));
    }
  }
  return written;
}

// Reads the section of a result file; nothing if there is no such file.
std::optional<WrittenSection> read_found_out(const std::filesystem::path& file,
                                             const FoundOut& found_out) {
  if (!std::filesystem::exists(file)) {
    return std::nullopt;
  }
  const std::string name = file.string();
  std::vector<WrittenSection> written = read_sections(name, parse_toml(read_file(file), name));
  if (written.size() != 2 || written[1].kind != found_out.kind || !written[0].settings.empty()) {
    fail_at(name, 1,
            fmt::format("must hold one table, [{}], as tactus {} writes it", found_out.kind,
                        found_out.verb));
  }
  return std::move(written[1]);
}

const char* reference_words(drivers::ReferenceKind kind) {
  switch (kind) {
    case drivers::ReferenceKind::absolute:
      return "absolute";
    case drivers::ReferenceKind::board:
      return "referenced by its board";
    case drivers::ReferenceKind::known_pose:
      return "referenced in a known pose";
    case drivers::ReferenceKind::index:
      return "referenced by its index";
    case drivers::ReferenceKind::hard_stop:
      return "referenced at a hard stop";
  }
  return "";
}

bool is_for_these_settings(const LoadedDevice& device, std::string_view kind) {
  return kind == firmware::kCertificateKind ? device.config().certification.is_for_these_settings
                                            : device.config().commissioning.is_for_these_settings;
}

}  // namespace

LoadedDevice::LoadedDevice(std::vector<std::byte> image, const std::string& name)
    : image_(std::move(image)), config_(std::make_unique<firmware::DeviceConfig>()) {
  firmware::DeviceSections sections;
  auto outcome = firmware::open_device_image(image_, sections);
  if (outcome) {
    outcome = firmware::read_device(sections, *config_);
  }
  if (!outcome) {
    const firmware::DeviceError& error = outcome.error();
    throw InputError(error.key.empty() ? fmt::format("{}: {}", name, error.what)
                                       : fmt::format("{}: {} {}", name, error.key, error.what));
  }
  settings_checksum_ = firmware::settings_checksum(sections);
  all_settings_checksum_ = firmware::all_settings_checksum(sections);
}

bool describes_device(const std::filesystem::path& file) {
  return parse_toml(read_file(file), file.string()).contains("mechanism");
}

LoadedDevice bake_device(const std::filesystem::path& file) {
  const std::string name = file.string();
  std::vector<WrittenSection> written = read_device_file(name);
  (void)write_checked(written);  // an error of the device's own comes first
  std::vector<std::string> warnings = check_shafts(written);
  for (const FoundOut& found_out : kFoundOut) {
    const std::filesystem::path beside = found_out.path(file);
    std::optional<WrittenSection> section = read_found_out(beside, found_out);
    if (!section) {
      warnings.push_back(fmt::format("{}: {}; run: tactus {} {}", name, found_out.without_it,
                                     found_out.verb, name));
      continue;
    }
    written.push_back(std::move(*section));
    if (!is_for_these_settings(LoadedDevice(write_checked(written), name), found_out.kind)) {
      written.pop_back();
      warnings.push_back(
          fmt::format("{}: not taken in, because the settings of {} have been changed since; run "
                      "again: tactus {} {}",
                      beside.string(), name, found_out.verb, name));
    }
  }
  LoadedDevice device(write_checked(written), name);
  for (std::string& warning : warnings) {
    device.warn(std::move(warning));
  }
  return device;
}

LoadedDevice load_device(const std::filesystem::path& file) {
  if (file.extension() != ".toml") {
    const std::string text = read_file(file);
    const auto bytes = std::as_bytes(std::span(text));
    return {{bytes.begin(), bytes.end()}, file.string()};
  }
  if (!describes_device(file)) {
    throw InputError(
        fmt::format("{}: is no device, it has no [mechanism]; write a device.toml or its image",
                    file.string()));
  }
  return bake_device(file);
}

std::string in_words(const firmware::DeviceConfig& config) {
  std::string text =
      fmt::format("{} joint{} on {} connection{} at {} Hz", config.joint_count,
                  config.joint_count == 1 ? "" : "s", config.connection_count,
                  config.connection_count == 1 ? "" : "s", config.controller.rate_hz);
  for (std::size_t i = 0; i < config.joint_count; ++i) {
    const firmware::JointConfig& joint = config.joints[i];
    text += fmt::format("\n  {}: motor {}, encoder {}, {}", joint.name, joint.motor_name,
                        joint.encoder_name, reference_words(joint.reference.kind));
  }
  for (std::size_t i = 0; i < config.connection_count; ++i) {
    constexpr double kPercent = 100.0;
    if (const double load = firmware::bus_load(config, i); load > 0.0) {
      text += fmt::format("\n  {}: the bus is at most {:.0f} % full", config.connections[i].name,
                          kPercent * load);
    }
  }
  const firmware::StiffnessCertificate& limits = config.certification.limits;
  if (limits.exists()) {
    text += fmt::format("\n  certified for surfaces of up to {:.0f} N/m without damping",
                        firmware::certified_stiffness(limits, 0.0));
  }
  return text;
}

}  // namespace tactus::host
