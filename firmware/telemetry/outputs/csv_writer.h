// Writes ticks as a CSV file: a line of column names, then a line a tick. record_fields.h says what
// the columns are. Memory of its own, no heap; not real time; one thread.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/telemetry/outputs/file_sink.h"
#include "firmware/telemetry/outputs/text_buffer.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

class CsvWriter {
 public:
  CsvWriter() = default;
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  ~CsvWriter() = default;

  // Columns for so many joints. 0, or errno.
  int open(const char* path, std::size_t joints, IfThere if_there = IfThere::replace);
  // Numbers read back as they were; a mode and a request are words, the state hash hexadecimal.
  void add(const RecordedTick& tick);
  // Puts what there is into the file.
  void flush();
  // 0, or the errno of the first failure.
  int close();

  [[nodiscard]] bool is_open() const { return sink_.is_open(); }
  [[nodiscard]] int error() const { return sink_.error(); }

 private:
  static constexpr std::size_t kLongestLine = 8192;

  FileSink sink_;
  std::size_t joints_ = 0;
  std::array<char, 16 * kLongestLine> memory_{};
  TextBuffer text_{memory_};
};

}  // namespace tactus::firmware
