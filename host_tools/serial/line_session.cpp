#include "host_tools/serial/line_session.h"

#include <fmt/format.h>

#include <optional>
#include <span>
#include <utility>

#include "firmware/control/mode.h"
#include "hal/linux/system.h"
#include "host_tools/serial/relay.h"

namespace tactus::host {

LineSession::LineSession(GatewayOptions options) {
  options.run_dir = folder_.path();
  gateway_ = std::make_unique<LineGateway>(std::move(options));
  thread_ = std::jthread([this] {
    try {
      gateway_->run(is_to_end_);
    } catch (...) {
      error_ = std::current_exception();
      has_failed_ = true;
    }
  });
}

LineSession::~LineSession() {
  is_to_end_ = true;
}

void LineSession::finish() {
  is_to_end_ = true;
  if (thread_.joinable()) {
    thread_.join();
  }
  if (error_) {
    std::rethrow_exception(std::exchange(error_, nullptr));
  }
}

Reply send_stop_over_line(const SerialPlace& place) {
  constexpr hal::TimeNs kStopPatience_ns = hal::kNsPerSecond;
  BoardLink link(place);
  std::optional<firmware::Answer> taken;
  const auto hear = [&](std::span<const std::byte> message) {
    firmware::Answer answer;
    if (firmware::read_message(message, answer) && answer.ticket == kStopTicket &&
        answer.request == firmware::Request::estop) {
      taken = answer;
    }
  };
  const hal::TimeNs begin_ns = hal::monotonic_now_ns();
  hal::TimeNs sent_ns = 0;
  while (!taken && hal::monotonic_now_ns() - begin_ns < kStopPatience_ns) {
    if (hal::monotonic_now_ns() - sent_ns >= kStopAgain_ns) {
      sent_ns = hal::monotonic_now_ns();
      link.send(firmware::LineStop{.ticket = kStopTicket});
    }
    link.listen(sent_ns + kStopAgain_ns, hear);
  }
  if (!taken) {
    throw UnreachableError(link.name() + ": no reply to the stop; cut the power of the motors");
  }
  return {.is_ok = true,
          .text = fmt::format("ok estop tick={} mode={}", taken->tick, mode_name(taken->after)),
          .lines = {}};
}

}  // namespace tactus::host
