#include "host_tools/flash/emulator_pace.h"

#include <fmt/format.h>
#include <sys/socket.h>

#include <array>
#include <charconv>

namespace tactus::host {
namespace {

constexpr std::string_view kPrompt = "(qemu) ";
// COUNTER of the board's FPGAIO block counts its clock of 25 MHz (ARM DAI 0500, "Application Note
// AN500"; QEMU, hw/misc/mps2-fpgaio.c).
constexpr std::uint32_t kCounterAddress = 0x4002'8018;
constexpr hal::TimeNs kNsPerBoardCount = 40;
// The board's time is looked at so often, and it may be ahead by so much.
constexpr hal::TimeNs kBetweenLooks_ns = 6'000'000;
constexpr hal::TimeNs kMostAhead_ns = 3'000'000;
// A board that is behind by more does not make up for it.
constexpr hal::TimeNs kMostBehind_ns = 20'000'000;

}  // namespace

std::optional<std::uint32_t> word_of_monitor(std::string_view answer) {
  constexpr std::string_view kBefore = ": 0x";
  const std::size_t at = answer.rfind(kBefore);
  if (at == std::string_view::npos) {
    return std::nullopt;
  }
  const std::string_view digits = answer.substr(at + kBefore.size());
  std::uint32_t word = 0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), word, 16);
  return error == std::errc{} ? std::optional(word) : std::nullopt;
}

void EmulatorPace::say(std::string_view order) {
  const std::string line = fmt::format("{}\n", order);
  // If QEMU has ended, the bridge sees it.
  (void)!::send(monitor_.get(), line.data(), line.size(), MSG_NOSIGNAL);
  has_prompt_ = false;
  heard_.clear();
}

void EmulatorPace::take_time(std::uint32_t counter, hal::TimeNs now_ns) {
  if (!counter_) {
    begin_ns_ = now_ns;
  } else {
    board_ns_ += kNsPerBoardCount * static_cast<hal::TimeNs>(counter - *counter_);
  }
  counter_ = counter;
  const hal::TimeNs ahead_ns = board_ns_ - (now_ns - begin_ns_);
  if (ahead_ns < -kMostBehind_ns) {
    begin_ns_ -= ahead_ns;
  }
  if (ahead_ns > kMostAhead_ns) {
    say("stop");
    is_paused_ = true;
    due_ns_ = now_ns + ahead_ns;
  }
}

void EmulatorPace::turn(hal::TimeNs now_ns) {
  std::array<char, 4096> room{};
  const ssize_t got = ::recv(monitor_.get(), room.data(), room.size(), MSG_DONTWAIT);
  if (got > 0) {
    heard_.append(room.data(), static_cast<std::size_t>(got));
  }
  if (!has_prompt_ && heard_.ends_with(kPrompt)) {
    has_prompt_ = true;
    if (const auto counter = word_of_monitor(heard_); counter) {
      due_ns_ = now_ns + kBetweenLooks_ns;
      take_time(*counter, now_ns);
    }
  }
  if (!has_prompt_ || now_ns < due_ns_) {
    return;
  }
  if (is_paused_) {
    is_paused_ = false;
    due_ns_ = now_ns;
    say("cont");
  } else {
    due_ns_ = now_ns + kBetweenLooks_ns;
    say(fmt::format("xp {:#x}", kCounterAddress));
  }
}

}  // namespace tactus::host
