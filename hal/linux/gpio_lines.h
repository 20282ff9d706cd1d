// Lines of a Linux GPIO chip, through libgpiod 2. Errors and threads are those of GpioLines.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/gpio_lines.h"

// The types of libgpiod are only declared, so that users of this header do not need its header.
struct gpiod_edge_event_buffer;
struct gpiod_line_request;

namespace tactus::hal {

// Returns true if this build has libgpiod 2. Without it no line can be requested: `not_supported`.
[[nodiscard]] bool has_libgpiod();

// A request of lines. Between request and release, get, set and read_edges allocate nothing:
// libgpiod 2.1 keeps their arguments on the stack and the edges in the buffer made by `request`.
// Each read of edges zeroes that buffer, 88 bytes per event, so it holds 64 events even if the
// kernel keeps more; the rest comes with the next call.
//
// Edges of two lines may be swapped if different processors serve the lines' interrupts. It shows
// as a gap in `sequence`. Pin the interrupts to one processor.
//
// If a chip goes away while read_edges waits, that may be noticed only at the deadline.
class LinuxGpioLines final : public GpioLines {
 public:
  // `chip` is a label or a path, see open_gpio_chip. Each `request` looks it up, so that a chip
  // that came back can be requested again. `request` also returns:
  //   not_found         no such chip
  //   invalid_argument  two chips have that label
  explicit LinuxGpioLines(std::string_view chip) : chip_(chip) {}
  LinuxGpioLines(const LinuxGpioLines&) = delete;
  LinuxGpioLines& operator=(const LinuxGpioLines&) = delete;
  ~LinuxGpioLines();

 private:
  Result<void> DoRequest(const GpioRequest& request) override;
  void DoRelease() override;
  Result<std::uint64_t> DoGet(std::uint64_t mask) override;
  Result<void> DoSet(std::uint64_t mask, std::uint64_t values) override;
  Result<std::size_t> DoReadEdges(std::span<GpioEdgeEvent> events, TimeNs deadline_ns) override;

  // Writes the offsets of the lines in `mask` to the front of `offsets` and returns their number.
  std::size_t offsets_in(std::uint64_t mask, std::array<unsigned, kMaxGpioLines>& offsets) const;

  std::string chip_;
  gpiod_line_request* request_ = nullptr;
  gpiod_edge_event_buffer* buffer_ = nullptr;
  // The lines' numbers on the chip, in the order of the request.
  std::array<std::uint32_t, kMaxGpioLines> offsets_{};
};

}  // namespace tactus::hal
