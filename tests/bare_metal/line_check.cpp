// The host at the other end of a board's UART, for tests/checks/m7_image.sh. The UART is a
// pseudo-terminal of QEMU.
//   line_check talk TERMINAL DEVICE.tactus SCENE.tactus   talks as a host does, until the board has
//                                                         taken a silent host as a lost line
//   line_check leave TERMINAL                             supervises the active board and goes
// It ends with 1, and says why, if the board does anything else than it should.
#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/line/frame.h"
#include "firmware/line/message.h"
#include "firmware/safety/faults.h"
#include "hal/clock.h"
#include "hal/linux/mapped_file.h"
#include "hal/linux/serial_port.h"
#include "rendering/scene/image_format.h"

namespace {

using namespace tactus::firmware;  // NOLINT(google-build-using-namespace)

constexpr std::chrono::seconds kLongestWait{60};
// A write or a read ends after so long at the latest.
constexpr tactus::hal::TimeNs kWait_ns = 200'000'000;

void require(bool holds, const char* what) {
  if (!holds) {
    std::printf("line_check: FAILS: %s\n", what);
    std::exit(EXIT_FAILURE);
  }
  std::printf("line_check: %s\n", what);
  std::fflush(stdout);
}

// Everything that has come from the board, and the way to say something.
class Host {
 public:
  explicit Host(const char* terminal) {
    require(port_.open(terminal, 115'200).has_value(), "the terminal is there");
  }

  template <class Message>
  void say(const Message& message) {
    std::array<std::byte, kMaxMessage> room{};
    std::vector<std::byte> frame;
    put_frame(write_message(message, room), [&](std::byte byte) { frame.push_back(byte); });
    require_in_time(port_.write(frame, deadline()) == frame.size(), "the board hears the host");
  }

  // Takes what comes until it is enough.
  void hear_until(const char* what, const std::function<bool()>& is_enough) {
    const auto end = std::chrono::steady_clock::now() + kLongestWait;
    while (!is_enough()) {
      require_in_time(std::chrono::steady_clock::now() < end, what);
      hear();
    }
    require(true, what);
  }

  // Sends a request, and returns its answer.
  Answer ask(const Command& command) {
    const std::size_t before = answers.size();
    say(command);
    hear_until("the board answers", [&] { return answers.size() > before; });
    return answers.back();
  }

  // Brings the controller to force.
  void activate() {
    for (const Request request : {Request::reset, Request::home}) {
      ask({.kind = CommandKind::request, .ticket = ++ticket_, .request = request});
    }
    hear_until("the controller is ready",
               [&] { return !ticks.empty() && ticks.rbegin()->second.record.mode == Mode::ready; });
    const Answer answer =
        ask({.kind = CommandKind::request, .ticket = ++ticket_, .request = Request::enable});
    require(answer.outcome == Outcome::done && answer.after == Mode::active, "it is active");
  }

  [[nodiscard]] bool has_line(std::string_view begin) const {
    return text.starts_with(begin) || text.find("\n" + std::string(begin)) != std::string::npos;
  }

  std::map<std::uint64_t, RecordedTick> ticks;
  std::vector<Answer> answers;
  std::vector<Hello> hellos;
  std::vector<std::byte> image;
  std::string text;

  [[nodiscard]] std::uint32_t broken() const { return reader_.broken(); }

 private:
  void require_in_time(bool holds, const char* what) const {
    if (!holds) {
      std::printf("line_check: %zu ticks, %zu answers, %u broken frames; the board's lines:\n%s\n",
                  ticks.size(), answers.size(), broken(), text.c_str());
      require(false, what);
    }
  }

  void hear() {
    std::array<std::byte, 4096> bytes;
    const auto count = port_.read(bytes, deadline());
    require_in_time(count || count.error().code == tactus::hal::ErrorCode::timeout, "QEMU goes on");
    for (const std::byte byte : std::span(bytes).first(count.value_or(0))) {
      const Heard heard = reader_.take(byte);
      text += heard.text;
      if (!heard.message.empty()) {
        take(heard.message);
      }
    }
  }

  void take(std::span<const std::byte> message) {
    if (RecordedTick tick; read_message(message, tick)) {
      ticks.emplace(tick.record.tick, tick);
    } else if (Answer answer; read_message(message, answer)) {
      answers.push_back(answer);
    } else if (Hello hello; read_message(message, hello)) {
      hellos.push_back(hello);
    } else if (ImagePart part; read_message(message, part)) {
      require_in_time(part.offset == image.size(), "the parts of an image come in their order");
      image.insert(image.end(), part.bytes.begin(), part.bytes.end());
    } else {
      require(false, "every frame of the board is a message of a board");
    }
  }

  static tactus::hal::TimeNs deadline() {
    return std::chrono::steady_clock::now().time_since_epoch().count() + kWait_ns;
  }

  tactus::hal::LinuxSerialPort port_;
  FrameReader reader_;
  Ticket ticket_ = 1000;
};

// The line "tick N hash H" of a tick says its hash.
bool is_hash_of_line(const Host& host, std::uint64_t number) {
  const std::string begin = "tick " + std::to_string(number) + " hash ";
  const std::size_t at = host.text.find(begin);
  const auto tick = host.ticks.find(number - 1);
  if (at == std::string::npos || tick == host.ticks.end()) {
    return false;
  }
  std::array<char, 17> hash{};
  std::snprintf(hash.data(), hash.size(), "%016llx",
                static_cast<unsigned long long>(tick->second.record.state_hash));
  return host.text.compare(at + begin.size(), 16, hash.data()) == 0;
}

void check_hello(Host& host, std::span<const std::byte> device, std::span<const std::byte> scene) {
  host.say(AskHello{});
  host.hear_until("a hello comes", [&] { return !host.hellos.empty(); });
  const Hello& hello = host.hellos.front();
  require(text_of(hello.board) == "mps2_an500" && text_of(hello.profile) == "microcontroller" &&
              hello.rate_hz == 1000.0 && hello.joints == 3,
          "it names the board");
  require(hello.device.bytes == device.size() && hello.scene.bytes == scene.size() &&
              hello.device.checksum == tactus::rendering::header_checksum(device) &&
              hello.scene.checksum == tactus::rendering::header_checksum(scene),
          "it has the checksums of the images");
  require(hello.broken_frames == 0 && hello.lost_bytes == 0, "nothing was lost");
}

// The ticks that came one after the other up to the last one, with none left out between them.
std::uint64_t ticks_in_a_row(const Host& host) {
  std::uint64_t count = 0;
  std::uint64_t dropped = 0;
  std::uint64_t next = 0;
  for (const auto& [number, tick] : host.ticks) {
    const bool follows = count > 0 && number == next && tick.dropped == dropped;
    count = follows ? count + 1 : 1;
    dropped = tick.dropped;
    next = number + 1;
  }
  return count;
}

// Every tick that did not come was counted as left out.
bool is_every_gap_counted(const Host& host) {
  const auto& [first, first_tick] = *host.ticks.begin();
  const auto& [last, last_tick] = *host.ticks.rbegin();
  const std::uint64_t missing = last - first + 1 - host.ticks.size();
  return missing == last_tick.dropped - first_tick.dropped;
}

// A machine that has no time for this program lets QEMU's terminal run full: the board then leaves
// ticks out, as on a slow line.
void check_ticks(Host& host) {
  constexpr std::uint64_t kTicks = 1000;
  host.say(AskTicks{.every = 1});
  host.hear_until("a thousand ticks come in a row", [&] { return ticks_in_a_row(host) >= kTicks; });
  require(is_every_gap_counted(host), "those that were left out are counted");
  require(host.broken() == 0, "every frame is whole");
  const std::uint64_t first = host.ticks.rbegin()->first;
  const std::uint64_t line = (first / 1000 + 1) * 1000;
  host.hear_until("a line of text comes between them", [&] {
    return host.has_line("tick " + std::to_string(line) + " hash ") &&
           host.has_line("load " + std::to_string(line) + " ") && host.ticks.contains(line - 1);
  });
  require(is_hash_of_line(host, line), "its hash is the tick's");
}

void check_image(Host& host, std::span<const std::byte> device) {
  host.say(AskImage{.image = BoardImage::device,
                    .offset = 0,
                    .bytes = static_cast<std::uint32_t>(device.size())});
  host.hear_until("the device image comes", [&] { return host.image.size() >= device.size(); });
  require(std::ranges::equal(host.image, device), "it has the bytes of the file");
}

void check_set(Host& host) {
  const ParameterChange change{.place = {.parameter = Parameter::max_force}, .value = 2.0};
  const Answer answer = host.ask({.kind = CommandKind::set, .ticket = 5, .change = change});
  require(answer.ticket == 5 && answer.outcome == Outcome::done && answer.value.value == 2.0,
          "a parameter is set");
  host.hear_until("the tick of the answer comes", [&] { return host.ticks.contains(answer.tick); });
  require(host.ticks.at(answer.tick).record.change.value == 2.0, "it has the change");
}

void check_stop(Host& host) {
  host.hear_until("the board is active by itself",
                  [&] { return host.ticks.rbegin()->second.record.mode == Mode::active; });
  const std::size_t before = host.answers.size();
  host.say(LineStop{.ticket = 6});
  host.hear_until("a stop is answered", [&] { return host.answers.size() > before; });
  const Answer& answer = host.answers.back();
  require(answer.ticket == 6 && answer.request == Request::estop &&
              answer.outcome == Outcome::done && answer.after == Mode::fault,
          "the force is gone");
  host.hear_until("its tick comes", [&] { return host.ticks.contains(answer.tick); });
  require(host.ticks.at(answer.tick).record.faults == kFaultOperatorStop, "it has the fault");
  host.hear_until("the line tells it", [&] { return host.has_line("fault 9 operator_stop "); });
}

void check_silence(Host& host) {
  host.activate();
  host.say(Alive{});
  host.hear_until("the line tells that it is lost",
                  [&] { return host.has_line("fault 46 line_lost "); });
  host.hear_until("the tick with the fault comes",
                  [&] { return host.ticks.rbegin()->second.record.mode == Mode::fault; });
  const TelemetryRecord& record = host.ticks.rbegin()->second.record;
  require(record.faults == kFaultLineLost, "it has the fault of a lost line");
}

int talk(std::span<char*> arguments) {
  tactus::hal::MappedFile device;
  tactus::hal::MappedFile scene;
  require(device.open(arguments[3]) == 0 && scene.open(arguments[4]) == 0, "the images are there");
  Host host(arguments[2]);
  check_hello(host, device.bytes(), scene.bytes());
  check_ticks(host);
  check_image(host, device.bytes());
  check_set(host);
  check_stop(host);
  check_silence(host);
  return EXIT_SUCCESS;
}

int leave(std::span<char*> arguments) {
  Host host(arguments[2]);
  host.say(AskTicks{.every = 100});
  host.hear_until("the board is active", [&] {
    return !host.ticks.empty() && host.ticks.rbegin()->second.record.mode == Mode::active;
  });
  host.say(AskTicks{.every = 0});
  host.say(Alive{});
  return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** arguments) {
  const std::span all(arguments, static_cast<std::size_t>(count));
  if (all.size() == 5 && std::string_view(all[1]) == "talk") {
    return talk(all);
  }
  if (all.size() == 3 && std::string_view(all[1]) == "leave") {
    return leave(all);
  }
  std::fputs("usage: line_check talk TERMINAL DEVICE SCENE | line_check leave TERMINAL\n", stderr);
  return 2;
}
