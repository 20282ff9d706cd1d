#include "host_tools/bake/device/written_sections.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cstring>

#include "firmware/device_file/device_image.h"
#include "host_tools/input_error.h"
#include "rendering/scene/image_format.h"

namespace tactus::host {
namespace {

namespace device_image = firmware::image;

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

}  // namespace

void fail_at(std::string_view file, std::size_t line, const std::string& what) {
  throw InputError(fmt::format("{}:{}: {}", file, line, what));
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

std::vector<std::byte> image_of(std::span<const WrittenSection> sections) {
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

}  // namespace tactus::host
