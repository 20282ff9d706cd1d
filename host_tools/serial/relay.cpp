#include "host_tools/serial/relay.h"

#include <algorithm>
#include <array>
#include <utility>

#include "firmware/control/parameter_name.h"
#include "hal/linux/system.h"

namespace tactus::host {
namespace {

using firmware::Answer;
using firmware::Command;
using firmware::CommandKind;
using firmware::Outcome;

// The command socket has refused a command that had no answer for a second.
constexpr hal::TimeNs kGiveUp_ns = hal::kNsPerSecond + hal::kNsPerSecond / 2;

// Returns the event of a command that took effect.
std::optional<firmware::TelemetryEvent> event_of(const Command& command, const Answer& answer) {
  firmware::TelemetryEvent event{.tick = answer.tick};
  const bool has_tick = answer.outcome == Outcome::done || answer.outcome == Outcome::no_effect;
  if (command.kind == CommandKind::request && has_tick) {
    event.kind = firmware::EventKind::request;
    set_name(event, firmware::kRequestNames[static_cast<std::size_t>(command.request)]);
    return event;
  }
  if (command.kind == CommandKind::set && answer.outcome == Outcome::done) {
    std::array<char, firmware::kMaxParameterName> name{};
    event.kind = firmware::EventKind::parameter;
    event.value = command.change.value;
    set_name(event, firmware::write_parameter_name(command.change.place, name));
    return event;
  }
  return std::nullopt;
}

}  // namespace

Relay::Relay(firmware::CommandQueue& queue, Senders senders, std::size_t most_waiting)
    : queue_(queue), senders_(std::move(senders)), most_waiting_(most_waiting) {}

std::size_t Relay::waiting() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      sent_, [](const Sent& sent) { return sent.command.kind != CommandKind::request; }));
}

void Relay::send_waiting(hal::TimeNs now_ns) {
  give_up(now_ns);
  // A stop that comes while another is under way is sent after that one's answer.
  if (stop_sent_ns_ ? now_ns - *stop_sent_ns_ >= kStopAgain_ns : queue_.take_stop()) {
    send_stop(now_ns);
  }
  while (const auto request = queue_.take_request()) {
    send(*request, now_ns);
  }
  while (waiting() < most_waiting_) {
    const auto command = queue_.take_command();
    if (!command) {
      return;
    }
    send(*command, now_ns);
  }
}

void Relay::send(const Command& command, hal::TimeNs now_ns) {
  sent_.push_back({.command = command, .sent_ns = now_ns});
  senders_.command(command);
}

void Relay::send_stop(hal::TimeNs now_ns) {
  stop_sent_ns_ = now_ns;
  senders_.stop({.ticket = kStopTicket});
}

// The queue has room for another command only after an answer, so it gets one that no client waits
// for any more.
void Relay::give_up(hal::TimeNs now_ns) {
  std::erase_if(sent_, [&](const Sent& sent) {
    const bool is_late = now_ns - sent.sent_ns > kGiveUp_ns;
    if (is_late && sent.command.kind != CommandKind::request) {
      queue_.answer({.ticket = sent.command.ticket,
                     .kind = sent.command.kind,
                     .outcome = Outcome::superseded});
    }
    return is_late;
  });
}

std::optional<firmware::TelemetryEvent> Relay::take(const Answer& answer) {
  const bool is_stop = answer.kind == CommandKind::request &&
                       answer.request == firmware::Request::estop && answer.ticket == kStopTicket &&
                       stop_sent_ns_.has_value();
  if (is_stop) {
    stop_sent_ns_.reset();
    queue_.answer_stop({.tick = answer.tick, .after = answer.after});
    return event_of({.kind = CommandKind::request, .request = answer.request}, answer);
  }
  const auto sent = std::ranges::find_if(sent_, [&](const Sent& each) {
    return each.command.ticket == answer.ticket && each.command.kind == answer.kind;
  });
  if (sent == sent_.end()) {
    return std::nullopt;
  }
  const Command command = sent->command;
  sent_.erase(sent);
  queue_.answer(answer);
  return event_of(command, answer);
}

}  // namespace tactus::host
