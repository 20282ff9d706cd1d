#include "firmware/bare_metal/host_line.h"

#include <algorithm>

#include "rendering/profiles/chosen_profile.h"
#include "rendering/scene/image_format.h"

namespace tactus::firmware {
namespace {

// The answers of one tick at most. More wait for the next one.
constexpr int kMostAnswers = 4;

ImageOnBoard image_on_board(std::span<const std::byte> image) {
  return {.checksum = rendering::header_checksum(image),
          .bytes = static_cast<std::uint32_t>(image.size())};
}

}  // namespace

HostLine::HostLine(const BoardFacts& facts)
    : facts_(facts), timeout_ticks_(static_cast<std::uint32_t>(facts.rate_hz * kLineTimeout_s)) {
  tick_.joint_count = static_cast<std::uint32_t>(facts.joints);
}

void HostLine::hear(char character, LineQueue& out) {
  const Heard heard = reader_.take(static_cast<std::byte>(character));
  if (!heard.message.empty()) {
    take(heard.message, out);
  }
}

// A message that cannot be read is no sign of the host.
void HostLine::take(std::span<const std::byte> message, LineQueue& out) {
  const auto type = type_of(message);
  if (!type) {
    return;
  }
  bool is_read = false;
  switch (*type) {
    case MessageType::ask_hello:
      is_read = message.size() == 1;
      owes_hello_ = owes_hello_ || is_read;
      break;
    case MessageType::ask_ticks:
      if (AskTicks ask; read_message(message, ask)) {
        is_read = true;
        every_ = ask.every;
      }
      break;
    case MessageType::ask_image:
      if (AskImage ask; read_message(message, ask)) {
        is_read = true;
        asked_ = ask;
      }
      break;
    case MessageType::command:
      if (Command command; read_message(message, command)) {
        is_read = true;
        take_command(command, out);
      }
      break;
    case MessageType::stop:
      if (LineStop stop; read_message(message, stop)) {
        is_read = true;
        stop_ = {.ticket = stop.ticket, .number = queue_.post_stop()};
      }
      break;
    case MessageType::alive:
      is_read = message.size() == 1;
      is_supervised_ = is_supervised_ || is_read;
      break;
    case MessageType::release:
      is_read = message.size() == 1;
      if (is_read) {
        end_requests();
      }
      break;
    default:
      break;
  }
  if (is_read) {
    silent_ticks_ = 0;
  }
}

void HostLine::take_command(const Command& command, LineQueue& out) {
  // A host that keeps to the hello's number never sends more.
  if (command.kind != CommandKind::request && !queue_.has_room()) {
    return;
  }
  if (const auto answer = queue_.post(command)) {
    send(*answer, 0, out);
  }
}

void HostLine::end_requests() {
  is_supervised_ = false;
  is_lost_ = false;
  every_ = 0;
  asked_ = {};
}

Request HostLine::before_tick(Controller& controller) {
  before_ = controller.mode();
  const Request asked = queue_.before_tick(controller);
  return queue_.is_operated() ? asked : request_toward_active(controller.mode());
}

std::uint32_t HostLine::line_status() {
  if (!is_supervised_) {
    return kLoopOnTime;
  }
  ++silent_ticks_;
  if (silent_ticks_ <= timeout_ticks_) {
    return kLoopOnTime;
  }
  is_supervised_ = false;
  is_lost_ = true;
  return kLoopLineLost;
}

void HostLine::after_tick(const Controller& controller, const LoopTimes& times,
                          std::uint32_t lost_bytes, LineQueue& out) {
  queue_.after_tick(controller);
  if (!send_stop_answer(controller, out) || !send_answers(out)) {
    skip_tick(controller.record().tick);
    return;
  }
  send_hello(controller, lost_bytes, out);
  const bool is_sent = send_tick(controller, times, out);
  send_image_part(out);
  // A recording ends with a tick that has the fault.
  if (is_lost_ && (is_sent || every_ == 0)) {
    end_requests();
  }
}

bool HostLine::send_stop_answer(const Controller& controller, LineQueue& out) {
  if (!stop_) {
    return true;
  }
  const auto taken = queue_.stop_taken(stop_->number);
  if (!taken) {
    return true;
  }
  const Answer answer{
      .ticket = stop_->ticket,
      .kind = CommandKind::request,
      .outcome = took_effect(Request::estop, taken->after) ? Outcome::done : Outcome::no_effect,
      .request = Request::estop,
      .before = before_,
      .after = taken->after,
      .tick = taken->tick,
      .faults = controller.record().faults};
  if (!send(answer, 0, out)) {
    return false;
  }
  stop_.reset();
  return true;
}

bool HostLine::send_answers(LineQueue& out) {
  for (int i = 0; i < kMostAnswers; ++i) {
    if (!waiting_answer_) {
      waiting_answer_ = queue_.next_answer();
    }
    if (!waiting_answer_) {
      return true;
    }
    if (!send(*waiting_answer_, 0, out)) {
      return false;
    }
    waiting_answer_.reset();
  }
  return true;
}

void HostLine::send_hello(const Controller& controller, std::uint32_t lost_bytes, LineQueue& out) {
  if (!owes_hello_) {
    return;
  }
  const Hello hello{.board = line_name(facts_.board),
                    .profile = line_name(rendering::kProfile.name),
                    .rate_hz = facts_.rate_hz,
                    .joints = static_cast<std::uint8_t>(facts_.joints),
                    .device = image_on_board(facts_.device_image),
                    .scene = image_on_board(facts_.scene_image),
                    .next_tick = controller.next_tick(),
                    .most_waiting = static_cast<std::uint16_t>(kMaxWaiting),
                    .room_bytes = static_cast<std::uint16_t>(kLineQueueBytes),
                    .broken_frames = reader_.broken(),
                    .lost_bytes = lost_bytes};
  owes_hello_ = !send(hello, 0, out);
}

bool HostLine::is_asked_for(std::uint64_t tick) const {
  return every_ != 0 && tick % every_ == 0;
}

void HostLine::skip_tick(std::uint64_t tick) {
  tick_.dropped += is_asked_for(tick) ? 1U : 0U;
}

bool HostLine::send_tick(const Controller& controller, const LoopTimes& times, LineQueue& out) {
  if (!is_asked_for(controller.record().tick)) {
    return false;
  }
  tick_.record = controller.record();
  tick_.loop = times;
  const bool is_sent = send(tick_, kSpareBytes, out);
  if (!is_sent) {
    skip_tick(controller.record().tick);
  }
  return is_sent;
}

void HostLine::send_image_part(LineQueue& out) {
  if (asked_.bytes == 0) {
    return;
  }
  const auto image = asked_.image == BoardImage::device ? facts_.device_image : facts_.scene_image;
  const auto rest = image.subspan(std::min<std::size_t>(asked_.offset, image.size()));
  const ImagePart part{.image = asked_.image,
                       .offset = asked_.offset,
                       .bytes = rest.first(std::min<std::size_t>(
                           {rest.size(), std::size_t{asked_.bytes}, kImagePartBytes}))};
  if (!send(part, kSpareBytes, out)) {
    return;
  }
  const auto sent = static_cast<std::uint32_t>(part.bytes.size());
  asked_.offset += sent;
  asked_.bytes = sent == kImagePartBytes ? asked_.bytes - sent : 0;
}

template <class Message>
bool HostLine::send(const Message& message, std::size_t spare, LineQueue& out) {
  const auto bytes = write_message(message, message_);
  return out.has_room(bytes.size(), spare) && out.push_frame(bytes);
}

}  // namespace tactus::firmware
