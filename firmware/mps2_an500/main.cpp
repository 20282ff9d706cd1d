// The program of the board: a simulated device in the hand of a simulated user.
#include <string_view>

#include "firmware/bare_metal/board_loop.h"
#include "firmware/bare_metal/held_handle.h"
#include "firmware/bare_metal/loaded_controller.h"

extern "C" [[noreturn]] void run_program();

namespace {

constexpr std::string_view kBoard = "mps2_an500";

tactus::firmware::LoadedController loaded;
tactus::firmware::HeldHandle device;

}  // namespace

void run_program() {
  tactus::firmware::begin(kBoard);
  tactus::firmware::start_or_stop(loaded);
  device.start(loaded.device());
  tactus::firmware::run_for_ever(kBoard, loaded, device);
}
