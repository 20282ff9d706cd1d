#include "host_tools/export/npz.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/export/column_array.h"
#include "host_tools/export/zip_writer.h"

namespace tactus::host {
namespace {

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

void write_array(const std::string& name, const ColumnArray& array, ZipWriter& zip) {
  zip.begin(name + ".npy", array.size() * array.value_bytes());
  zip.write(npy_head(array.type(), array.size()));
  if (array.has_words()) {
    for (std::size_t i = 0; i < array.size(); ++i) {
      const std::vector<char32_t> text = array.text(i);
      zip.write(std::as_bytes(std::span(text)));
    }
  } else {
    zip.write(std::as_bytes(std::span(array.numbers())));
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
      arrays[i].append(values[columns[i].index]);
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
