#include "host_tools/bake/device/device_bake.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <span>

#include "firmware/device_file/bus_load.h"
#include "firmware/device_file/device_certificate.h"
#include "firmware/device_file/device_commissioning.h"
#include "firmware/device_file/device_generated.h"
#include "host_tools/bake/device/certificate_file.h"
#include "host_tools/bake/toml/key_advice.h"
#include "host_tools/bake/toml/toml_file.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "rendering/scene/image_format.h"

namespace tactus::host {
namespace {

namespace device_image = firmware::image;

struct WrittenSetting {
  std::string key;
  device_image::ValueType type = device_image::ValueType::number;
  std::vector<double> numbers;
  std::string text;
  std::size_t line = 0;
};

struct WrittenSection {
  std::string kind;
  std::string title;  // "[[joint]] 2"
  std::string file;
  std::size_t line = 0;
  std::vector<WrittenSetting> settings;
};

[[noreturn]] void fail_at(std::string_view file, std::size_t line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
}

WrittenSetting read_value(std::string_view file, std::string_view title, const std::string& key,
                          const toml::node& node) {
  WrittenSetting setting{.key = key, .line = node.source().begin.line};
  if (node.is_number()) {
    setting.numbers = {node.value<double>().value_or(0.0)};
  } else if (const auto flag = node.value_exact<bool>()) {
    setting.type = device_image::ValueType::flag;
    setting.numbers = {*flag ? 1.0 : 0.0};
  } else if (const auto text = node.value_exact<std::string>()) {
    setting.type = device_image::ValueType::text;
    setting.text = *text;
  } else if (const toml::array* array = node.as_array();
             array != nullptr && std::ranges::all_of(*array, &toml::node::is_number)) {
    setting.type = device_image::ValueType::numbers;
    for (const toml::node& element : *array) {
      setting.numbers.push_back(element.value<double>().value_or(0.0));
    }
  } else {
    fail_at(file, setting.line,
            fmt::format("{}: {} must be a number, true or false, a text or a list of numbers",
                        title, key));
  }
  return setting;
}

WrittenSection read_section(std::string_view file, const std::string& kind,
                            const std::string& title, const toml::table& table) {
  WrittenSection section{.kind = kind,
                         .title = title,
                         .file = std::string(file),
                         .line = table.source().begin.line,
                         .settings = {}};
  for (const auto& [key, node] : table) {
    section.settings.push_back(read_value(file, title, std::string(key.str()), node));
  }
  return section;
}

std::vector<WrittenSection> read_sections(std::string_view file, const toml::table& root) {
  std::vector<WrittenSection> sections;
  WrittenSection top{.kind = "device",
                     .title = "top of the file",
                     .file = std::string(file),
                     .line = 1,
                     .settings = {}};
  for (const auto& [key, node] : root) {
    const std::string name(key.str());
    if (const toml::table* table = node.as_table()) {
      sections.push_back(read_section(file, name, "[" + name + "]", *table));
    } else if (const toml::array* array = node.as_array();
               array != nullptr && !array->empty() &&
               array->is_homogeneous(toml::node_type::table)) {
      std::size_t number = 1;
      for (const toml::node& element : *array) {
        sections.push_back(
            read_section(file, name, fmt::format("[[{}]] {}", name, number), *element.as_table()));
        ++number;
      }
    } else {
      top.settings.push_back(read_value(file, top.title, name, node));
    }
  }
  sections.insert(sections.begin(), std::move(top));
  return sections;
}

std::vector<std::byte> write_device(std::span<const WrittenSection> sections) {
  flatbuffers::FlatBufferBuilder builder;
  std::vector<flatbuffers::Offset<device_image::Section>> stored;
  stored.reserve(sections.size());
  for (const WrittenSection& section : sections) {
    std::vector<flatbuffers::Offset<device_image::Setting>> settings;
    settings.reserve(section.settings.size());
    for (const WrittenSetting& setting : section.settings) {
      settings.push_back(device_image::CreateSetting(
          builder, builder.CreateString(setting.key), setting.type,
          builder.CreateVector(setting.numbers), builder.CreateString(setting.text)));
    }
    stored.push_back(device_image::CreateSection(builder, builder.CreateString(section.kind),
                                                 builder.CreateVector(settings)));
  }
  device_image::FinishDeviceBuffer(
      builder, device_image::CreateDevice(builder, builder.CreateVector(stored)));
  const auto payload = std::as_bytes(std::span(builder.GetBufferPointer(), builder.GetSize()));
  rendering::ImageHeader header{.magic = firmware::kDeviceMagic,
                                .version = firmware::kDeviceFormatVersion,
                                .payload_bytes = payload.size()};
  header.checksum = rendering::image_checksum(header, payload);
  std::vector<std::byte> bytes(sizeof(header) + payload.size());
  std::memcpy(bytes.data(), &header, sizeof(header));
  std::ranges::copy(payload, bytes.begin() + sizeof(header));
  return bytes;
}

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
                setting.type == device_image::ValueType::numbers);
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
  std::vector<std::byte> bytes = write_device(written);
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
  std::vector<std::string> warnings;
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
