// The file of a flight recorder: its content beside the ticks, its name, and writing it. One thread
// at a time; not real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <ctime>
#include <span>

#include "firmware/linux/flight/flight_recorder.h"
#include "firmware/linux/telemetry/attachment_list.h"
#include "firmware/linux/telemetry/mcap_writer.h"
#include "firmware/linux/telemetry/run_recorder.h"

namespace tactus::firmware {

// The content of the files beside the ticks. All that it points to must outlive the writer, except
// the scene's image (see FlightWriter::use_scene). At most AttachmentList::kMost - 1 images and 22
// metadata entries are kept.
struct FlightPlan {
  // An existing folder for the files.
  const char* folder = ".";
  // The number of the device, 0 for the controller's first; the names of the files of others have
  // it.
  std::size_t device = 0;
  // The number of ticks per second.
  double rate_hz = 1000.0;
  // The metadata of the run.
  RunDescription run;
  // The images, such as the device's and the scene's.
  std::span<const Attachment> images;
};

// The result of writing a file.
struct WrittenFlight {
  // 0 or errno.
  int failed = 0;
  // The number of ticks in the file. It is 0 if the loop had overwritten the first one already.
  std::uint64_t ticks = 0;
};

// The files of one run, written one after the other.
class FlightFile {
 public:
  // Sets the content.
  void plan(const FlightPlan& plan);
  // Exchanges the image of the scene, which must stay valid until the next one.
  void use_scene(std::span<const std::byte> image);

  // Writes the window's state, if it has one, and its ticks to a new file. `now` is the time in the
  // file's name, s since 1970.
  WrittenFlight write(const FlightWindow& window, const FlightTicks& ticks, std::time_t now);

  // Returns the path of the last file.
  [[nodiscard]] const char* path() const { return path_.data(); }
  // Returns the number of ticks per second.
  [[nodiscard]] double rate_hz() const { return plan_.rate_hz; }

 private:
  static constexpr std::size_t kMaxInfo = 24;

  // Sets path_ to a name with the time, the tick and the device.
  void name(std::time_t now, std::uint64_t tick);

  FlightPlan plan_;
  AttachmentList images_;
  std::array<MetadataEntry, kMaxInfo> info_{};
  std::size_t info_count_ = 0;
  std::array<char, 16> scene_checksum_{};
  McapWriter file_;
  std::array<char, 512> path_{};
};

}  // namespace tactus::firmware
