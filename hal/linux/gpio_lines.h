// Lines of a GPIO chip of Linux, by libgpiod 2.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/gpio_lines.h"

// libgpiod's own types stay out of sight: users need not have its header.
struct gpiod_edge_event_buffer;
struct gpiod_line_request;

namespace tactus::hal {

// Between request and release get, set and read_edges allocate nothing: libgpiod 2.1 keeps their
// arguments on the stack and its edges in the buffer made by `request`. What they cost beside the
// system call: reading edges zeroes that buffer, 88 bytes an event, each time, so it is made for 64
// events however many the kernel keeps; more come with the next call.
//
// Edges of two lines may change places when the interrupts of the lines are served by different
// processors; it shows as a gap in `sequence`. Pin them to one.
//
// A chip that goes away while read_edges waits may be noticed only at the deadline.
class LinuxGpioLines final : public GpioLines {
 public:
  // As open_gpio_chip: a label, or a path. Looked up in each `request`, so that a chip that was
  // gone and came back can be requested again. `request` also returns:
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

  // The offsets of the lines in `mask`, at the front of `offsets`; how many.
  std::size_t offsets_in(std::uint64_t mask, std::array<unsigned, kMaxGpioLines>& offsets) const;

  std::string chip_;
  gpiod_line_request* request_ = nullptr;
  gpiod_edge_event_buffer* buffer_ = nullptr;
  std::array<std::uint32_t, kMaxGpioLines> offsets_{};
};

}  // namespace tactus::hal
