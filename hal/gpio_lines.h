// Several lines of one GPIO chip, requested together, for encoder edges, emergency stop, enable and
// direction of an axis.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "hal/clock.h"
#include "hal/error.h"

namespace tactus::hal {

// The largest number of lines of one request, one bit of a mask each.
inline constexpr std::size_t kMaxGpioLines = 64;
// The largest size of the edge buffer, in events.
inline constexpr std::size_t kMaxGpioEdgeBuffer = 1024;
// The default size of the edge buffer, in events for each line.
inline constexpr std::size_t kGpioEdgesPerLine = 16;

enum class GpioDirection : std::uint8_t { input, output };
// The pull resistor of a line; `as_is` keeps the one that the board has set.
enum class GpioBias : std::uint8_t { as_is, disabled, pull_up, pull_down };
// The output stage: open_drain drives low only, open_source high only.
enum class GpioDrive : std::uint8_t { push_pull, open_drain, open_source };
// The edges that a line reports, in logical levels.
enum class GpioEdges : std::uint8_t { none, rising, falling, both };

// The settings of one line. Values and edges are logical: active is 1, and rising means from
// inactive to active. `active_low` inverts the physical level.
struct GpioLineConfig {
  // The number of the line on the chip, from 0.
  std::uint32_t offset = 0;
  GpioDirection direction = GpioDirection::input;
  GpioBias bias = GpioBias::as_is;
  bool active_low = false;
  GpioEdges edges = GpioEdges::none;  // inputs only
  // Inputs only: a level counts when it has been stable for this time, us; 0 is off.
  std::uint32_t debounce_us = 0;
  GpioDrive drive = GpioDrive::push_pull;  // outputs only
  // Outputs only: the level from the request on.
  bool initial_active = false;
};

// The lines of one request. Bit i of every mask is lines[i].
struct GpioRequest {
  // The lines in the order of the bits of every mask.
  std::span<const GpioLineConfig> lines;
  // The name shown as the holder of the lines. Linux uses its first 31 characters.
  std::string_view consumer = "tactus";
  // The number of events that wait for read_edges; 0 stands for kGpioEdgesPerLine for each line.
  // The board may round it up.
  std::size_t edge_buffer = 0;
};

// An edge on one line. Sequence numbers start at 1 and wrap at 2^32. If the buffer is full, the
// oldest event is dropped, so a gap in the numbers shows a loss. After a loss `rising` may be wrong
// too: read the level. With a single line in the request the kernel does not count edges that its
// own interrupt missed, so request two or more lines if every edge matters.
struct GpioEdgeEvent {
  // Time of the interrupt, or with debouncing the time when the level had settled, on the clock of
  // Clock::now_ns.
  TimeNs time_ns = 0;
  std::uint32_t offset = 0;  // number of the line on the chip
  // The number of the edge among all lines of the request.
  std::uint32_t sequence = 0;
  // The number of the edge on its line.
  std::uint32_t line_sequence = 0;
  // True for an edge from inactive to active.
  bool rising = false;
};

// Counts the events that are missing in the sequence numbers of a request. Give it every event in
// order.
class GpioLossCounter {
 public:
  // Returns how many events are missing between the last event and this one.
  std::uint32_t saw(const GpioEdgeEvent& event) {
    const std::uint32_t missing = event.sequence - last_ - 1U;
    last_ = event.sequence;
    lost_ += missing;
    return missing;
  }
  // Returns the number of missing events so far.
  std::uint64_t lost() const { return lost_; }

 private:
  std::uint32_t last_ = 0;
  std::uint64_t lost_ = 0;
};

// A request of lines. A bit of a mask stands for a line, in the order of the request: bit 0 is
// lines[0].
//
// Real time: get, set and read_edges, between request and release; they allocate nothing. Thread:
// one at a time for each object; not from an interrupt. Each implementation has its own way to
// choose the chip. Every call can return, besides the errors that it lists:
//   disconnected   the chip is gone
//   invalid_state  nothing is requested
//   io             anything else the system reports
class GpioLines {
 public:
  GpioLines(const GpioLines&) = delete;
  GpioLines& operator=(const GpioLines&) = delete;

  // Requests all lines or, on an error, none. Not real time.
  //   invalid_argument  no line or more than kMaxGpioLines, an offset twice, edges or debounce on
  //                     an output, a drive on an input, a buffer above kMaxGpioEdgeBuffer
  //   invalid_state     lines are held already
  //   busy              another request holds one of the lines
  //   not_found         the chip has no such line
  //   not_supported     a line cannot do it (no interrupt for edges, no such bias), or the lines
  //                     differ in more settings than the system can take at once (Linux: 10)
  //   not_permitted, no_memory
  Result<void> request(const GpioRequest& request);

  // Releases the lines, or does nothing if none are held. The level of an output afterwards depends
  // on the board.
  void release();

  // Returns the number of lines held; 0 before a request.
  std::size_t line_count() const { return count_; }

  // Returns the levels of the lines in `mask`, inputs and outputs; the other bits are 0. Debounced
  // lines give the settled level.
  //   invalid_argument  the mask is 0 or names a line that was not requested
  Result<std::uint64_t> get(std::uint64_t mask);

  // Sets the outputs in `mask` to the bits of `values`.
  //   invalid_argument  the mask is 0, or names an input or a line that was not requested
  Result<void> set(std::uint64_t mask, std::uint64_t values);

  // Waits until there is an edge or the deadline has passed. Then returns the number of events put
  // into `events`, at least 1, oldest first.
  //   timeout           no edge
  //   invalid_argument  `events` is empty
  //   invalid_state     no line of the request watches edges
  Result<std::size_t> read_edges(std::span<GpioEdgeEvent> events, TimeNs deadline_ns);

 protected:
  GpioLines() = default;
  ~GpioLines() = default;

 private:
  // The public functions have checked the arguments.
  virtual Result<void> DoRequest(const GpioRequest& request) = 0;
  virtual void DoRelease() = 0;
  virtual Result<std::uint64_t> DoGet(std::uint64_t mask) = 0;
  virtual Result<void> DoSet(std::uint64_t mask, std::uint64_t values) = 0;
  virtual Result<std::size_t> DoReadEdges(std::span<GpioEdgeEvent> events, TimeNs deadline_ns) = 0;

  std::size_t count_ = 0;
  // A bit for each line of the request that is an output.
  std::uint64_t outputs_ = 0;
  bool watches_edges_ = false;
};

}  // namespace tactus::hal
