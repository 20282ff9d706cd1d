#include "host_tools/serial/line_gateway.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <utility>

#include "firmware/linux/commands/device_folders.h"
#include "firmware/linux/commands/telemetry_hooks.h"
#include "hal/linux/system.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/files/cache_folder.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"

namespace tactus::host {
namespace {

using firmware::BoardImage;
using firmware::ImageOnBoard;

constexpr hal::TimeNs kMs = hal::kNsPerSecond / 1000;
// The queue has nothing to wait for, so it is looked at so often.
constexpr hal::TimeNs kTurn_ns = kMs;
// A fifth of the time after which the board takes its motors' power.
constexpr hal::TimeNs kBetweenAlive_ns =
    static_cast<hal::TimeNs>(firmware::kLineTimeout_s * 1e9) / 5;
// A board that sends no ticks is asked for a sign of life so often.
constexpr hal::TimeNs kBetweenHellos_ns = 400 * kMs;
// A board that starts waits somewhat longer than this for a host before its first tick.
constexpr hal::TimeNs kBetweenFirstAsks_ns = 100 * kMs;
// A line on which nothing came for so long is lost.
constexpr hal::TimeNs kSilence_ns = 2000 * kMs;

constexpr std::string_view kSceneRefusal =
    "a board's scene is part of its program: bake the scene, link the program anew, and write it "
    "by tactus flash";
constexpr std::string_view kInjectRefusal =
    "a board takes no faults from outside; tactus sim --serve --allow-inject does";

// Returns true for a line that carries bytes faster than any rate: an emulator's.
bool is_fast(const SerialPlace& place) {
  return place.is_socket || place.path.starts_with("/dev/pts/");
}

}  // namespace

std::uint32_t ticks_apart(const SerialPlace& place, double rate_hz) {
  if (is_fast(place)) {
    return 1;
  }
  // A byte takes ten bits, and a part of the line is left to answers and texts.
  constexpr double kBits = 10.0;
  constexpr double kShare = 0.8;
  std::array<std::byte, firmware::kMaxMessage> room{};
  const auto frame_bytes = static_cast<double>(
      firmware::most_frame_bytes(firmware::write_message(firmware::RecordedTick{}, room).size()));
  const double ticks_per_s = kShare * place.baud / (kBits * frame_bytes);
  return static_cast<std::uint32_t>(std::max(1.0, std::ceil(rate_hz / ticks_per_s)));
}

LineGateway::LineGateway(GatewayOptions options)
    : options_(std::move(options)), link_(options_.place, options_.text) {
  ask_for_board();
  choose_ticks();
  if (options_.wants_images) {
    get_images();
  }
  open_sockets();
}

LineGateway::~LineGateway() {
  if (server_) {
    server_->stop();
  }
}

// A recording can only begin with the board's first tick if the ticks are asked for at once.
void LineGateway::ask_for_board() {
  const bool asks_ticks = options_.wants_ticks && (options_.every > 0 || is_fast(options_.place));
  const hal::TimeNs begin_ns = hal::monotonic_now_ns();
  while (!has_board_) {
    const hal::TimeNs now_ns = hal::monotonic_now_ns();
    if (other_version_) {
      lost(
          fmt::format("the board speaks version {} of the line's messages, and this program {}; "
                      "write a program of this version by tactus flash",
                      *other_version_, firmware::kLineVersion));
    }
    if (static_cast<double>(now_ns - begin_ns) > options_.patience_s * 1e9) {
      lost(link_.bytes() == 0
               ? "the board says nothing; does it run, and is this its line?"
               : fmt::format("{} bytes came and none of them is the answer of a board; is {} bit/s "
                             "its rate?",
                             link_.bytes(), options_.place.baud));
    }
    if (now_ns - asked_ns_ > kBetweenFirstAsks_ns) {
      asked_ns_ = now_ns;
      if (asks_ticks) {
        link_.send(firmware::AskTicks{.every = std::max(options_.every, 1U)});
      }
      link_.send(firmware::AskHello{});
    }
    link_.listen(now_ns + kBetweenFirstAsks_ns / 4,
                 [this](std::span<const std::byte> message) { hear(message); });
  }
}

void LineGateway::choose_ticks() {
  if (options_.wants_ticks) {
    every_ = options_.every > 0 ? options_.every : ticks_apart(options_.place, board_.rate_hz);
  }
  link_.send(firmware::AskTicks{.every = every_});
}

void LineGateway::get_images() {
  const auto device = file_of(BoardImage::device, options_.device_image, board_.device);
  if (const int error = device_.open(device.c_str()); error != 0) {
    throw InputError(fmt::format("{}: {}", device.string(), std::strerror(error)));
  }
  const auto scene = file_of(BoardImage::scene, options_.scene_image, board_.scene);
  const auto opened = scenes_->open_next(std::filesystem::absolute(scene).string());
  if (!opened) {
    throw InputError(fmt::format("{}: {}", scene.string(), opened.error().what));
  }
  scenes_->use_next();
}

std::filesystem::path LineGateway::file_of(BoardImage image, const std::string& given,
                                           const ImageOnBoard& wanted) {
  if (!given.empty()) {
    check_user_image(given, wanted);
    return given;
  }
  const std::filesystem::path cache = user_cache_folder();
  const std::filesystem::path folder = cache.empty() ? options_.run_dir : cache;
  std::filesystem::path file = image_file(folder, image, wanted.checksum);
  if (!is_image_file(file, wanted)) {
    const auto bytes = fetch_image(
        link_, image, wanted, [this](std::span<const std::byte> message) { hear(message); },
        options_.progress);
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    write_file_atomically(file, bytes);
  }
  return file;
}

void LineGateway::open_sockets() {
  std::error_code error;
  std::filesystem::create_directories(options_.run_dir, error);
  const std::string folder = options_.run_dir.string();
  telemetry_.start(board_, {.device = device_.bytes(), .scene = scenes_->bytes()}, folder,
                   options_.record);
  const std::array names{firmware::text_of(board_.board)};
  if (const int failed = firmware::link_device_names(folder.c_str(), names); failed != 0) {
    throw InputError(fmt::format("{}: {}", folder, std::strerror(failed)));
  }
  relay_.emplace(
      *queue_,
      Relay::Senders{.stop = [this](const firmware::LineStop& stop) { link_.send(stop); },
                     .command = [this](const firmware::Command& command) { link_.send(command); }},
      board_.most_waiting);
  server_ = std::make_unique<firmware::CommandServer>(
      *queue_, options_.wants_images ? scenes_.get() : nullptr);
  const std::string socket = (options_.run_dir / kCommandSocket).string();
  const std::string stop_socket = (options_.run_dir / kStopSocket).string();
  firmware::RunHooks hooks = firmware::telemetry_hooks(telemetry_.sinks());
  hooks.scene_refusal = kSceneRefusal;
  hooks.inject_refusal = kInjectRefusal;
  const auto started = server_->start(
      {.socket_path = socket.c_str(), .stop_socket_path = stop_socket.c_str(), .hooks = hooks});
  if (!started) {
    throw InputError(fmt::format("{}: {} ({}); --run-dir names another folder", socket,
                                 started.error().what, std::strerror(started.error().errno_value)));
  }
}

void LineGateway::run(const std::atomic<bool>& is_to_end) {
  try {
    while (!is_to_end.load(std::memory_order_relaxed)) {
      turn();
    }
    link_.send(firmware::AskTicks{.every = 0});
    link_.send(firmware::Release{});
  } catch (const UnreachableError&) {
    finish();
    throw;
  }
  finish();
}

void LineGateway::turn() {
  link_.listen(hal::monotonic_now_ns() + kTurn_ns,
               [this](std::span<const std::byte> message) { hear(message); });
  const hal::TimeNs now_ns = hal::monotonic_now_ns();
  if (relay_) {
    relay_->send_waiting(now_ns);
  }
  keep_alive(now_ns);
  telemetry_.pass_on();
  if (const int error = telemetry_.recording_error(); error != 0) {
    throw InputError(
        fmt::format("{}: the recording ended early: {}", options_.record, std::strerror(error)));
  }
}

void LineGateway::keep_alive(hal::TimeNs now_ns) {
  if (now_ns - alive_ns_ >= kBetweenAlive_ns) {
    alive_ns_ = now_ns;
    link_.send(firmware::Alive{});
  }
  const hal::TimeNs silent_ns = now_ns - link_.heard_ns();
  if (silent_ns > kSilence_ns) {
    lost(
        "nothing has come over the line for two seconds: the cable was pulled, or the board has "
        "stopped; without this program it takes its motors' power away by itself");
  }
  if (silent_ns > kBetweenHellos_ns && now_ns - asked_ns_ > kBetweenHellos_ns) {
    asked_ns_ = now_ns;
    link_.send(firmware::AskHello{});
  }
}

void LineGateway::hear(std::span<const std::byte> message) {
  firmware::Hello hello;
  firmware::RecordedTick tick;
  firmware::Answer answer;
  if (firmware::read_message(message, tick)) {
    telemetry_.add(tick);
  } else if (firmware::read_message(message, answer)) {
    const auto event = relay_ ? relay_->take(answer) : std::nullopt;
    if (event) {
      telemetry_.add(*event);
    }
  } else if (firmware::read_message(message, hello)) {
    check_hello(hello);
  } else if (const auto version = firmware::hello_version(message);
             version && *version != firmware::kLineVersion) {
    other_version_ = version;
  }
}

void LineGateway::check_hello(const firmware::Hello& hello) {
  if (!has_board_) {
    board_ = hello;
    has_board_ = true;
    return;
  }
  const bool is_other = hello.device.checksum != board_.device.checksum ||
                        hello.scene.checksum != board_.scene.checksum;
  if (is_other || hello.next_tick < board_.next_tick) {
    lost(
        fmt::format("the board has started anew, after tick {}; its own line says why: tactus "
                    "line shows it",
                    telemetry_.last_tick()));
  }
}

std::uint64_t LineGateway::missing_ticks() const {
  if (telemetry_.ticks() == 0 || every_ == 0) {
    return 0;
  }
  const std::uint64_t wanted = (telemetry_.last_tick() - telemetry_.first_tick()) / every_ + 1;
  return wanted - std::min(wanted, telemetry_.ticks());
}

void LineGateway::finish() {
  server_->stop();
  telemetry_.stop();
}

void LineGateway::lost(std::string_view why) const {
  throw UnreachableError(fmt::format("{}: {}", link_.name(), why));
}

}  // namespace tactus::host
