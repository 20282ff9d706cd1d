#include "host_tools/cli/emulate_verb.h"

#include <CLI/CLI.hpp>

#include "host_tools/cli/emulate_devices.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kEmulateExamples =
    "Each device has its own help: tactus emulate odrive --help. What is faked and what is not, "
    "the\n"
    "columns of the truth and how to set up interfaces: host_tools/emulators/README.md.\n"
    "\n"
    "Examples (as root, for a virtual bus: modprobe vcan; ip link add dev vcan0 type vcan;\n"
    "ip link set vcan0 mtu 72; ip link set vcan0 up):\n"
    "  tactus emulate odrive --can vcan0 --nodes 0,1,2 --mechanism woodenhaptics --ratio 16,12,12\n"
    "  tactus emulate odrive --can vcan0 --nodes 0,1,2 --device-file arm.toml   an own device\n"
    "  tactus emulate odrive --can vcan0 --hand pen --path wish.csv --truth truth.csv --seconds "
    "10\n"
    "  tactus emulate moteus --can vcan0 --fault 1:silent@3 --fault all:none@4 --realtime 60\n"
    "  tactus emulate cia402 --can can1 --nodes 5 --mechanism hapkit --counts 8192\n"
    "  tactus emulate falcon --hand firm --path out_and_in.csv\n"
    "  tactus emulate haply --pty\n"
    "  tactus emulate paddle --pins encoder_a=0,encoder_b=1,direction=2,enable=3 --ratio 17.45";

}  // namespace

void add_emulate_verb(CLI::App& app) {
  CLI::App* const verb = app.add_subcommand(
      "emulate", "Play a haptic device from the other side of a CAN bus, USB, a tty or GPIO lines");
  verb->require_subcommand(0, 1);
  verb->footer(kEmulateExamples);
  add_emulated_can_devices(*verb);
  add_emulated_boards(*verb);
  verb->callback([verb] {
    if (verb->get_subcommands().empty()) {
      throw InputError(
          "say which device: odrive, moteus, cia402, vesc, falcon, haply or paddle; see tactus "
          "emulate --help");
    }
  });
}

}  // namespace tactus::host
