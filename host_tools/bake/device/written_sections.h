// The sections of a device file as its owner wrote them, and the image of them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/device_file/device_generated.h"
#include "host_tools/bake/toml/toml_file.h"

namespace tactus::host {

struct WrittenSetting {
  std::string key;
  firmware::image::ValueType type = firmware::image::ValueType::number;
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

// Throws an InputError about that line.
[[noreturn]] void fail_at(std::string_view file, std::size_t line, const std::string& what);

// Returns the sections of a file: the keys at its top, then its tables in the order of their names.
// Throws InputError for a value of a type that no key has.
std::vector<WrittenSection> read_sections(std::string_view file, const toml::table& root);

// Returns the image of the sections. Keys and values are as they were written, and not checked.
std::vector<std::byte> image_of(std::span<const WrittenSection> sections);

}  // namespace tactus::host
