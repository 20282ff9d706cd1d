#include "host_tools/export/npz.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <variant>
#include <vector>

#include "host_tools/export/zip_writer.h"

namespace tactus::host {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays are little-endian");

// The values of a column: a number's bits for each tick, or a word, which lives as long as the
// program.
struct ColumnArray {
  // The array's type in numpy's notation; empty for words, whose length is not known before the
  // last tick.
  std::string_view type;
  std::vector<std::uint64_t> numbers;
  std::vector<std::string_view> words;
};

void append(ColumnArray& array, const ColumnValue& value) {
  std::visit(
      [&](const auto& each) {
        using Value = std::remove_cvref_t<decltype(each)>;
        if constexpr (std::is_same_v<Value, std::string_view>) {
          array.words.push_back(each);
        } else if constexpr (std::is_same_v<Value, HashValue>) {
          array.type = "<u8";
          array.numbers.push_back(each.hash);
        } else {
          array.type = std::is_same_v<Value, double>         ? "<f8"
                       : std::is_same_v<Value, std::int64_t> ? "<i8"
                                                             : "<u8";
          array.numbers.push_back(std::bit_cast<std::uint64_t>(each));
        }
      },
      value);
}

// Returns the head of an array in the format NPY, version 1.0: its bytes end at a multiple of 64.
std::string npy_head(std::string_view type, std::size_t count) {
  constexpr std::size_t kAlignment = 64;
  const std::string_view magic("\x93NUMPY\x01\x00", 8);
  std::string words =
      fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({},), }}", type, count);
  const std::size_t bytes = magic.size() + sizeof(std::uint16_t) + words.size() + 1;
  words.append((kAlignment - bytes % kAlignment) % kAlignment, ' ').append(1, '\n');
  std::string head(magic);
  head += static_cast<char>(words.size() % 256);
  head += static_cast<char>(words.size() / 256);
  return head + words;
}

// Writes words as numpy's texts: four bytes a character, filled up with zeros.
void write_words(const std::vector<std::string_view>& words, ZipWriter& zip) {
  std::size_t longest = 1;
  for (const std::string_view word : words) {
    longest = std::max(longest, word.size());
  }
  zip.write(npy_head(fmt::format("<U{}", longest), words.size()));
  std::vector<char32_t> characters(longest);
  for (const std::string_view word : words) {
    const auto end = std::ranges::transform(word, characters.begin(), [](char each) {
                       return static_cast<char32_t>(static_cast<unsigned char>(each));
                     }).out;
    std::fill(end, characters.end(), U'\0');
    zip.write(std::as_bytes(std::span(characters)));
  }
}

void write_array(const std::string& name, const ColumnArray& array, ZipWriter& zip) {
  constexpr std::size_t kLargestWord_bytes = 256;
  zip.begin(name + ".npy",
            array.numbers.size() * sizeof(double) + array.words.size() * kLargestWord_bytes);
  if (array.words.empty()) {
    zip.write(npy_head(array.type, array.numbers.size()));
    zip.write(std::as_bytes(std::span(array.numbers)));
  } else {
    write_words(array.words, zip);
  }
  zip.end();
}

// Reads some columns of the chosen ticks and writes them.
void write_columns(Recording& recording, const ExportChoice& choice,
                   std::span<const ChosenColumn> columns, std::size_t joints,
                   const std::function<void(double time_s)>& see, ZipWriter& zip) {
  std::vector<ColumnArray> arrays(columns.size());
  std::vector<ColumnValue> values;
  visit_chosen_ticks(recording, choice, see, [&](const firmware::RecordedTick& tick) {
    read_columns(tick, joints, values);
    for (std::size_t i = 0; i < columns.size(); ++i) {
      append(arrays[i], values[columns[i].index]);
    }
  });
  for (std::size_t i = 0; i < columns.size(); ++i) {
    write_array(columns[i].name, arrays[i], zip);
  }
}

}  // namespace

ExportSummary write_npz(Recording& recording, const ExportChoice& choice,
                        std::span<const ChosenColumn> columns, const std::filesystem::path& output,
                        const std::function<void(double time_s)>& see, const NpzRoom& room) {
  const std::size_t joints = joints_of(recording);
  ZipWriter zip(output);
  const ExportSummary summary =
      visit_chosen_ticks(recording, choice, see, [](const firmware::RecordedTick&) {});
  const std::size_t column_bytes = summary.ticks * sizeof(std::string_view);
  const std::size_t together =
      std::clamp<std::size_t>(room.room_bytes / column_bytes, 1, columns.size());
  for (std::size_t first = 0; first < columns.size(); first += together) {
    const std::size_t count = std::min(together, columns.size() - first);
    write_columns(recording, choice, columns.subspan(first, count), joints, see, zip);
  }
  zip.commit();
  return summary;
}

}  // namespace tactus::host
