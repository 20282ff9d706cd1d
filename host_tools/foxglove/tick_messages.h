// The messages of a device: what a tick says, as Foxglove's poses and markers and as numbers and
// words under the names of `tactus watch`. One thread.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "firmware/telemetry/recorded_tick.h"
#include "host_tools/foxglove/protocol.h"
#include "host_tools/foxglove/schemas.h"
#include "host_tools/monitor/tick_words.h"

namespace tactus::host {

// The topics of one device.
class DeviceTopics {
 public:
  // `prefix` stands before each topic: empty, or "/left" where a controller has several devices.
  // The device has so many joints.
  DeviceTopics(const std::string& prefix, std::size_t joints);

  // Returns the channels in the order in which message() counts them.
  [[nodiscard]] const std::vector<FoxgloveChannel>& channels() const { return channels_; }
  // Returns the joints that the topics are for.
  [[nodiscard]] std::size_t joints() const { return joints_; }

  // Takes a tick over, for the messages that follow. `radius_m` is that of the tool.
  void take(const firmware::RecordedTick& tick, std::uint64_t time_ns, double radius_m);
  // Returns the message of a channel.
  [[nodiscard]] std::string message(std::size_t channel) const;

 private:
  // A topic of numbers and words: the columns that it has, as indices of column_names().
  using Columns = std::vector<std::size_t>;

  // Return messages of the tick.
  [[nodiscard]] std::string markers() const;
  [[nodiscard]] std::string fields(const Columns& columns) const;

  std::size_t joints_ = 0;
  std::string prefix_;
  std::vector<FoxgloveChannel> channels_;
  // The names of all columns, and the columns of each topic after the fixed ones.
  std::vector<std::string> names_;
  std::vector<Columns> columns_;
  std::vector<TickWord> words_;
  firmware::RecordedTick tick_;
  std::uint64_t time_ns_ = 0;
  double radius_m_ = 0.0;
};

}  // namespace tactus::host
