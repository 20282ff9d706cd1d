// Writes ticks as a CSV file: a line of column names, then one line per tick. record_fields.h
// defines the columns. It has its own memory and uses no heap. Not real time; one thread.
#pragma once

#include <array>
#include <cstddef>

#include "firmware/linux/telemetry/file_sink.h"
#include "firmware/linux/telemetry/text_buffer.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

// The writer of one file.
class CsvWriter {
 public:
  CsvWriter() = default;
  CsvWriter(const CsvWriter&) = delete;
  CsvWriter& operator=(const CsvWriter&) = delete;
  ~CsvWriter() = default;

  // Creates the file with columns for `joints` joints. Returns 0 or errno.
  int open(const char* path, std::size_t joints, IfThere if_there = IfThere::replace);
  // Adds a line. Numbers read back to the same bits; mode and request are names, the state hash is
  // hexadecimal.
  void add(const RecordedTick& tick);
  // Writes the buffer to the file.
  void flush();
  // Writes the buffer and closes the file. Returns 0 or the errno of the first failure.
  int close();

  // Returns true between open() and close().
  [[nodiscard]] bool is_open() const { return sink_.is_open(); }
  // Returns 0 or the errno that ended the file.
  [[nodiscard]] int error() const { return sink_.error(); }

 private:
  // The largest size of a line: the buffer is written when it has no room for one more.
  static constexpr std::size_t kLongestLine = 8192;

  FileSink sink_;
  std::size_t joints_ = 0;
  std::array<char, 16 * kLongestLine> memory_{};
  TextBuffer text_{memory_};
};

}  // namespace tactus::firmware
