// The functions of hal/bare_metal/board.h for the board MPS2 with the FPGA image AN500.
#include "hal/bare_metal/board.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "firmware/mps2_an500/memory_map.h"
#include "firmware/mps2_an500/registers.h"

extern "C" {
void tick_handler();
void receive_handler();
void send_handler();
}

namespace tactus::mps2_an500 {
namespace {

// The periods that have ended since start_ticks, and the counts of one.
volatile std::uint32_t ended_periods = 0;
std::uint32_t period_counts = 0;
std::uint32_t seen_periods = 0;

// The characters that were received: an interrupt adds them, get_char takes them. A power of two,
// so that the counts may wrap.
constexpr std::uint32_t kReceivedRoom = 512;
std::array<volatile char, kReceivedRoom> received{};
volatile std::uint32_t received_end = 0;
volatile std::uint32_t received_begin = 0;
volatile std::uint32_t lost_count = 0;

constexpr std::uint32_t kNsPerCount = 1'000'000'000 / kClock_Hz;
constexpr std::uint32_t kCountsPerUs = kClock_Hz / 1'000'000;

// A handler may need the UART at any time, so it is set anew wherever it is used.
void start_uart() {
  reg(kUartDivider) = kClock_Hz / kUartBaud;
  reg(kUartControl) = kUartRuns;
}

}  // namespace
}  // namespace tactus::mps2_an500

void tick_handler() {
  tactus::mps2_an500::ended_periods = tactus::mps2_an500::ended_periods + 1;
}

// The UART holds one character; one that comes before it is read is lost, and the UART says so.
void receive_handler() {
  using namespace tactus::mps2_an500;  // NOLINT(google-build-using-namespace)
  reg(kUartInterrupts) = kUartReceived;
  if ((reg(kUartState) & kUartHasLost) != 0) {
    reg(kUartState) = kUartHasLost;
    lost_count = lost_count + 1;
  }
  while ((reg(kUartState) & kUartHasReceived) != 0) {
    const auto character = static_cast<char>(reg(kUartData));
    const std::uint32_t end = received_end;
    if (end - received_begin == kReceivedRoom) {
      lost_count = lost_count + 1;
      continue;
    }
    received[end % kReceivedRoom] = character;
    received_end = end + 1;
  }
}

// It ends the sleep of wait_for_tick, after which the loop sends the next character.
void send_handler() {
  using namespace tactus::mps2_an500;  // NOLINT(google-build-using-namespace)
  reg(kUartInterrupts) = kUartSent;
}

namespace tactus::hal {

using namespace mps2_an500;  // NOLINT(google-build-using-namespace)

void motors_off() {
  reg(kLamps) = 0;
}

void motors_on() {
  reg(kLamps) = kMotorLamp;
}

void start_ticks(std::uint32_t rate_hz) {
  period_counts = kClock_Hz / rate_hz;
  reg(kTickReload) = period_counts - 1;
  reg(kTickValue) = 0;
  reg(kTickControl) = kTickRuns;
  start_uart();
  reg(kInterruptEnable) = kUartReceives | kUartSends;
}

std::uint32_t wait_for_tick() {
  // With interrupts masked one that comes between the look and the sleep still ends the sleep.
  asm volatile("cpsid i" ::: "memory");
  if (ended_periods == seen_periods) {
    asm volatile("wfi" ::: "memory");
  }
  asm volatile("cpsie i\n isb" ::: "memory");
  const std::uint32_t now = ended_periods;
  const std::uint32_t ended = now - seen_periods;
  seen_periods = now;
  return ended;
}

std::uint64_t now_ns() {
  for (;;) {
    const std::uint32_t before = ended_periods;
    const std::uint32_t left = reg(kTickValue);
    if (before == ended_periods) {
      const std::uint64_t counts = std::uint64_t{before} * period_counts + (period_counts - left);
      return counts * kNsPerCount;
    }
  }
}

void start_watchdog(std::uint32_t timeout_us) {
  reg(kWatchdogLock) = kWatchdogKey;
  reg(kWatchdogLoad) = timeout_us * kCountsPerUs;
  reg(kWatchdogControl) = kWatchdogInterrupts | kWatchdogResets;
  reg(kWatchdogClear) = 1;
}

void feed_watchdog() {
  reg(kWatchdogClear) = 1;
}

bool put_char(char character) {
  start_uart();
  if ((reg(kUartState) & kUartIsFull) != 0) {
    return false;
  }
  reg(kUartData) = static_cast<unsigned char>(character);
  return true;
}

bool get_char(char& character) {
  const std::uint32_t begin = received_begin;
  if (begin == received_end) {
    return false;
  }
  character = received[begin % kReceivedRoom];
  received_begin = begin + 1;
  return true;
}

std::uint32_t lost_chars() {
  return lost_count;
}

LatchedStop& latched_stop() {
  return ::latched_stop;
}

std::span<const std::uint32_t> stack_memory() {
  return {&stack_begin, &stack_end};
}

BoardImages images() {
  return {.device = {&device_image_begin, &device_image_end},
          .scene = {&scene_image_begin, &scene_image_end}};
}

void halt() {
  for (;;) {
    asm volatile("wfi");
  }
}

}  // namespace tactus::hal
