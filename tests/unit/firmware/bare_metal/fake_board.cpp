#include "tests/unit/firmware/bare_metal/fake_board.h"

#include <cstdio>
#include <cstdlib>

namespace tactus::hal {
namespace {

struct FakeBoardState {
  FakeBoard board;
  std::uint32_t offers = 0;
  StopCode seen = StopCode::none;
  bool is_in_text = false;
  std::uint64_t now_ns = 0;
  bool is_half_over = false;
};

FakeBoardState& fake_state() {
  static FakeBoardState state;
  return state;
}

// Writes down a code that was latched since the last event.
void see_latch() {
  FakeBoardState& state = fake_state();
  const StopCode code = latched_code(state.board.latched);
  if (code == state.seen) {
    return;
  }
  state.seen = code;
  if (state.is_in_text) {
    state.board.events += "' ";
    state.is_in_text = false;
  }
  state.board.events += "latch " + std::to_string(static_cast<std::uint32_t>(code)) + ' ';
}

void write_down(const std::string& event) {
  see_latch();
  FakeBoardState& state = fake_state();
  if (state.is_in_text) {
    state.board.events += "' ";
    state.is_in_text = false;
  }
  state.board.events += event + ' ';
}

}  // namespace

FakeBoard& fake_board() {
  return fake_state().board;
}

void power_up_fake_board() {
  fake_state() = FakeBoardState{};
}

void motors_off() {
  fake_state().board.has_power = false;
  write_down("off");
}

void motors_on() {
  fake_state().board.has_power = true;
  write_down("on");
}

void start_watchdog(std::uint32_t timeout_us) {
  write_down("watchdog " + std::to_string(timeout_us) + " us");
}

bool put_char(char character) {
  see_latch();
  FakeBoardState& state = fake_state();
  if (state.board.offers_per_char == 0 || ++state.offers % state.board.offers_per_char != 0) {
    return false;
  }
  if (!state.is_in_text) {
    state.board.events += '\'';
    state.is_in_text = true;
  }
  state.board.sent += character;
  if (character != '\r') {
    const char shown = character == '\n' ? '/' : character;
    state.board.events += shown == '\0' ? '~' : shown;
  }
  return true;
}

bool get_char(char& character) {
  std::deque<char>& received = fake_state().board.received;
  if (received.empty()) {
    return false;
  }
  character = received.front();
  received.pop_front();
  return true;
}

std::uint32_t lost_chars() {
  return kFakeLostChars;
}

void start_ticks(std::uint32_t rate_hz) {
  write_down("ticks " + std::to_string(rate_hz) + " Hz");
}

// Something else ends every second sleep.
std::uint32_t wait_for_tick() {
  FakeBoardState& state = fake_state();
  state.now_ns += kFakePeriod_ns / 2;
  state.is_half_over = !state.is_half_over;
  return state.is_half_over ? 0 : 1;
}

std::uint64_t now_ns() {
  return fake_state().now_ns;
}

void feed_watchdog() {
  ++fake_state().board.fed;
}

LatchedStop& latched_stop() {
  return fake_state().board.latched;
}

std::span<const std::uint32_t> stack_memory() {
  return fake_state().board.stack;
}

BoardImages images() {
  const FakeBoard& board = fake_state().board;
  return {.device = board.device_image, .scene = board.scene_image};
}

void halt() {
  write_down("halt");
  std::fputs(fake_state().board.events.c_str(), stderr);
  std::_Exit(kHalted);
}

}  // namespace tactus::hal
