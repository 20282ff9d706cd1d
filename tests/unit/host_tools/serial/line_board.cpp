#include "tests/unit/host_tools/serial/line_board.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "firmware/control/run_tick.h"
#include "host_tools/bake/device/device_bake.h"
#include "host_tools/bake/scene/bake.h"
#include "rendering/scene/image_format.h"
#include "tests/support/paths.h"

namespace tactus::host {
namespace {

constexpr const char* kLineScene = R"([tool]
radius_m = 0.003
[[object]]
name = "ball"
primitive = "sphere"
radius_m = 0.04
stiffness_N_per_m = 500.0
)";

firmware::ImageOnBoard on_board(std::span<const std::byte> image) {
  return {.checksum = rendering::header_checksum(image),
          .bytes = static_cast<std::uint32_t>(image.size())};
}

}  // namespace

LineBoardImages bake_line_images() {
  return {.device = bake_device(testing::in_repository("firmware/mps2_an500/device.toml")).image(),
          .scene = bake_scene(parse_scene_description(kLineScene, "scene.toml")).bytes};
}

LineBoard::LineBoard(const LineBoardImages& images) : images_(images) {
  const auto started = loaded_->start(images.device, images.scene);
  EXPECT_TRUE(started.has_value()) << (started ? "" : started.error().what);
  handle_.start(loaded_->device());
  heard_ns_ = hal::monotonic_now_ns();
  thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

LineBoard::~LineBoard() {
  pull_cable();
}

void LineBoard::pull_cable() {
  if (thread_.joinable()) {
    thread_.request_stop();
    thread_.join();
  }
  line_.hang_up();
}

std::uint64_t LineBoard::hash_of(std::uint64_t tick) {
  const std::scoped_lock lock(mutex_);
  return tick < hashes_.size() ? hashes_[tick] : 0;
}

void LineBoard::run(const std::stop_token& stop) {
  constexpr hal::TimeNs kTimeout_ns = hal::kNsPerSecond / 2;
  while (!stop.stop_requested()) {
    receive();
    if (is_supervised_ && hal::monotonic_now_ns() - heard_ns_ > kTimeout_ns) {
      has_lost_host_ = true;
    }
    if (has_begun_) {
      tick();
    }
    std::this_thread::sleep_for(std::chrono::microseconds(300));
  }
}

void LineBoard::receive() {
  std::array<std::byte, 1024> room{};
  const ssize_t got = ::read(line_.board(), room.data(), room.size());
  for (const std::byte byte : std::span(room).first(got > 0 ? static_cast<std::size_t>(got) : 0)) {
    const firmware::Heard heard = reader_.take(byte);
    if (!heard.message.empty()) {
      heard_ns_ = hal::monotonic_now_ns();
      hear(heard.message);
    }
  }
}

void LineBoard::hear(std::span<const std::byte> message) {
  firmware::AskTicks ticks;
  firmware::AskImage image;
  firmware::Command command;
  firmware::LineStop stop;
  if (firmware::read_message(message, ticks)) {
    every_ = ticks.every;
    has_begun_ = true;
  } else if (firmware::read_message(message, image)) {
    ++image_asks_;
    send_image(image);
  } else if (firmware::read_message(message, command)) {
    if (const auto known = queue_.post(command)) {
      send(*known);
    }
  } else if (firmware::read_message(message, stop)) {
    if (troubles_.unheard_stops > 0) {
      --troubles_.unheard_stops;
    } else {
      queue_.post_stop();
      stop_waits_ = true;
      stop_ticket_ = stop.ticket;
    }
  } else if (firmware::type_of(message) == firmware::MessageType::ask_hello) {
    send(hello());
  } else if (firmware::type_of(message) == firmware::MessageType::alive) {
    is_supervised_ = true;
  } else if (firmware::type_of(message) == firmware::MessageType::release) {
    is_supervised_ = false;
  }
}

firmware::Hello LineBoard::hello() const {
  return {.version = troubles_.version,
          .board = firmware::line_name("test board"),
          .profile = firmware::line_name("desktop"),
          .rate_hz = loaded_->device().controller.rate_hz,
          .joints = static_cast<std::uint8_t>(handle_.joint_count()),
          .device = on_board(images_.device),
          .scene = on_board(images_.scene),
          .next_tick = loaded_->controller().next_tick(),
          .most_waiting = firmware::kMaxWaiting};
}

void LineBoard::send_image(const firmware::AskImage& ask) {
  const std::span<const std::byte> image =
      ask.image == firmware::BoardImage::device ? images_.device : images_.scene;
  const std::size_t end = std::min<std::size_t>(image.size(), ask.offset + ask.bytes);
  for (std::size_t at = ask.offset; at < end; at += firmware::kImagePartBytes) {
    const std::size_t count = std::min(end - at, firmware::kImagePartBytes);
    send(firmware::ImagePart{.image = ask.image,
                             .offset = static_cast<std::uint32_t>(at),
                             .bytes = image.subspan(at, count)});
  }
}

void LineBoard::tick() {
  firmware::Controller& controller = loaded_->controller();
  firmware::run_tick(controller, handle_, queue_.before_tick(controller));
  queue_.after_tick(controller);
  const firmware::TelemetryRecord& record = controller.record();
  {
    const std::scoped_lock lock(mutex_);
    hashes_.push_back(record.state_hash);
  }
  while (const auto answer = queue_.next_answer()) {
    send(*answer);
  }
  if (std::exchange(stop_waits_, false)) {
    send(firmware::Answer{.ticket = stop_ticket_,
                          .kind = firmware::CommandKind::request,
                          .request = firmware::Request::estop,
                          .after = record.mode,
                          .tick = record.tick});
  }
  if (every_ > 0 && record.tick % every_ == 0) {
    send(firmware::RecordedTick{.record = record,
                                .joint_count = static_cast<std::uint32_t>(handle_.joint_count())});
  }
}

template <class Message>
void LineBoard::send(const Message& message) {
  if (troubles_.is_mute) {
    return;
  }
  std::array<std::byte, firmware::kMaxMessage> room{};
  std::vector<std::byte> frame;
  firmware::put_frame(firmware::write_message(message, room),
                      [&](std::byte byte) { frame.push_back(byte); });
  ++frames_;
  if (troubles_.broken_every > 0 && frames_ % troubles_.broken_every == 0) {
    frame[frame.size() / 2] ^= std::byte{0x10};
  }
  send_bytes(frame);
}

void LineBoard::send_bytes(std::span<const std::byte> bytes) {
  constexpr int kPatience_ms = 200;
  while (!bytes.empty()) {
    pollfd waiting{.fd = line_.board(), .events = POLLOUT, .revents = 0};
    if (::poll(&waiting, 1, kPatience_ms) <= 0) {
      return;  // nobody reads
    }
    const ssize_t taken = ::write(line_.board(), bytes.data(), bytes.size());
    if (taken < 0) {
      return;
    }
    bytes = bytes.subspan(static_cast<std::size_t>(taken));
  }
}

}  // namespace tactus::host
