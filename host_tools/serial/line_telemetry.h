// The recording and the live telemetry of a board's run. The gateway's thread.
#pragma once

#include <array>
#include <cstddef>
#include <deque>
#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "firmware/line/message.h"
#include "firmware/linux/commands/telemetry_hooks.h"
#include "firmware/linux/telemetry/telemetry_writer.h"

namespace tactus::host {

// The images of the board, as far as they are known; empty otherwise. They outlive the telemetry.
struct KnownImages {
  std::span<const std::byte> device;
  std::span<const std::byte> scene;
};

// Passes a board's ticks on to what tactusd passes its own on to.
class LineTelemetry {
 public:
  // Starts the live socket in the folder and, if a file is named, the recording. Throws InputError
  // if one cannot be opened.
  void start(const firmware::Hello& board, const KnownImages& images,
             const std::filesystem::path& folder, const std::string& record);

  // Takes a tick. Before start() it waits.
  void add(const firmware::RecordedTick& tick);
  // Takes an event of a command.
  void add(const firmware::TelemetryEvent& event) { writer_->publish(event); }
  // Passes on ticks that wait, as many as the writer's thread can take at a time.
  void pass_on();

  // Ends the recording, after all ticks. Throws InputError if it has failed.
  void stop();

  // Returns where the command socket reaches the telemetry.
  [[nodiscard]] firmware::TelemetrySinks& sinks() { return sinks_; }
  [[nodiscard]] int recording_error() const { return writer_->recording_error(); }
  // Return how many ticks were taken, and the numbers of the first and the last one.
  [[nodiscard]] std::uint64_t ticks() const { return ticks_; }
  [[nodiscard]] std::uint64_t first_tick() const { return first_tick_; }
  [[nodiscard]] std::uint64_t last_tick() const { return last_tick_; }

 private:
  // Gives the writer the run's properties and images.
  void describe(const firmware::Hello& board, const KnownImages& images);
  // Adds a property of the run.
  void note(std::string_view key, std::string value);

  std::deque<firmware::RecordedTick> waiting_;
  // The properties in words, and the entries that view them.
  std::deque<std::string> words_;
  std::array<firmware::MetadataEntry, 8> info_;
  std::size_t info_count_ = 0;
  bool is_started_ = false;
  std::uint64_t ticks_ = 0;
  std::uint64_t first_tick_ = 0;
  std::uint64_t last_tick_ = 0;
  // It has megabytes, too many for the stack.
  std::unique_ptr<firmware::TelemetryWriter> writer_ =
      std::make_unique<firmware::TelemetryWriter>();
  firmware::TelemetrySinks sinks_{.writer = writer_.get()};
};

}  // namespace tactus::host
