// A device of a running controller, as the server shows it: its live socket, and its newest tick.
// It waits for a controller that has gone. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "host_tools/recording/live_reader.h"

namespace tactus::host {

// The place of a device.
struct DevicePlace {
  // The name that stands before its topics; empty if the controller has one device.
  std::string name;
  // The folder of its sockets.
  std::filesystem::path folder;
};

// Returns the devices of the controller with that folder, in their order: those that have a live
// socket. Their names are those of their images, or their numbers.
std::vector<DevicePlace> devices_in(const std::filesystem::path& run_dir);

class LiveDevice {
 public:
  // Connects. Throws InputError if no controller answers.
  explicit LiveDevice(DevicePlace place);

  // Takes the messages that have come. Connects again, once a second, to a controller that has
  // gone. Returns true if the scene may be another one.
  bool take_messages();

  [[nodiscard]] const DevicePlace& place() const { return place_; }
  // Returns the newest tick; nothing before the first.
  [[nodiscard]] const std::optional<firmware::RecordedTick>& newest() const { return newest_; }
  // Returns the places of the objects that move, if the controller has sent some.
  [[nodiscard]] const std::optional<firmware::ObjectPlaces>& places() const { return places_; }
  // Returns a time of the controller's clock as a time since 1970, ns.
  [[nodiscard]] std::uint64_t time_of(std::int64_t clock_ns) const {
    return static_cast<std::uint64_t>(clock_ns + clock_offset_ns_);
  }
  // Returns true while the controller is there.
  [[nodiscard]] bool is_there() const { return reader_.has_value(); }
  // Returns the descriptor that a poll waits for; -1 without a controller.
  [[nodiscard]] int descriptor() const { return reader_ ? reader_->descriptor() : -1; }

 private:
  void connect();
  void connect_again();
  void take(const firmware::RecordedTick& tick);

  DevicePlace place_;
  std::optional<LiveReader> reader_;
  std::chrono::steady_clock::time_point try_again_;
  std::optional<firmware::RecordedTick> newest_;
  std::optional<firmware::ObjectPlaces> places_;
  // The distance of the ticks' clock from 1970, ns.
  std::int64_t clock_offset_ns_ = 0;
};

}  // namespace tactus::host
