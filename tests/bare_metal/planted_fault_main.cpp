// For tests only: the program of a board with a device that does harm in one of its ticks. The link
// says which harm: --defsym planted_fault=N, a number of PlantedFault.
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>

#include "drivers/device.h"
#include "firmware/bare_metal/board_loop.h"
#include "firmware/bare_metal/held_handle.h"
#include "firmware/bare_metal/loaded_controller.h"

extern "C" {
[[noreturn]] void run_program();
// Its address is the number.
extern std::byte planted_fault;
}

namespace {

enum class PlantedFault : std::uint8_t { stack_overflow = 1, hung_tick = 2, nan_sample = 3 };

// The motors have their power by then, and the tool touches.
constexpr std::uint64_t kFaultyTick = 3500;

// Calls itself until the stack is full.
[[gnu::noinline]] std::uint32_t overflow(std::uint32_t depth) {
  std::array<volatile std::uint32_t, 32> room{};
  room[depth % room.size()] = depth;
  return overflow(depth + 1) + room[(depth + 1) % room.size()];
}

class HarmfulDevice {
 public:
  explicit HarmfulDevice(tactus::firmware::HeldHandle& handle) : handle_(handle) {}

  [[nodiscard]] std::size_t joint_count() const { return handle_.joint_count(); }
  void read(tactus::drivers::JointSample& sample) {
    handle_.read(sample);
    if (++tick_ != kFaultyTick) {
      return;
    }
    switch (static_cast<PlantedFault>(std::bit_cast<std::uintptr_t>(&planted_fault))) {
      case PlantedFault::stack_overflow:
        sample.age_us = overflow(0);
        break;
      case PlantedFault::hung_tick:
        for (volatile bool hangs = true; hangs;) {
        }
        break;
      case PlantedFault::nan_sample:
        sample.position[1] = std::numeric_limits<double>::quiet_NaN();
        break;
    }
  }
  std::uint32_t write(const tactus::drivers::JointCommand& command) {
    return handle_.write(command);
  }
  void clear_faults() { handle_.clear_faults(); }

 private:
  tactus::firmware::HeldHandle& handle_;
  std::uint64_t tick_ = 0;
};

constexpr std::string_view kBoard = "mps2_an500";

tactus::firmware::LoadedController loaded;
tactus::firmware::HeldHandle handle;

}  // namespace

void run_program() {
  tactus::firmware::begin(kBoard);
  tactus::firmware::start_or_stop(loaded);
  handle.start(loaded.device());
  HarmfulDevice device(handle);
  tactus::firmware::run_for_ever(kBoard, loaded, device);
}
