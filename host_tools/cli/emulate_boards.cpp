#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "host_tools/cli/emulate_devices.h"
#include "host_tools/cli/emulate_session.h"
#include "host_tools/emulators/board_devices.h"
#include "host_tools/emulators/gpio_sim_pins.h"
#include "host_tools/emulators/paddle_wiring.h"
#include "host_tools/emulators/serial_device.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The options of each board as the user gave them.
struct FalconOptions {
  MachineOptions machine;
  std::string function_fs = "/dev/ffs/falcon";
  std::string gadget = "/sys/kernel/config/usb_gadget/falcon";
  std::string controller = "dummy_udc.0";
  std::size_t firmware_bytes = 0;
  bool homed = false;
};

struct HaplyOptions {
  MachineOptions machine;
  std::string tty;
  bool pty = false;
  std::string gadget;
  std::string controller = "dummy_udc.0";
};

struct PaddleOptions {
  MachineOptions machine;
  std::string chip = "paddle";
  std::string pwm = "/run/pwm";
  std::vector<std::string> pins = {"encoder_a=0", "encoder_b=1", "direction=2", "enable=3"};
  unsigned counts = 1000;
  std::string bridge = "sign_magnitude";
  std::string law = "linear";
  double full_torque_Nm = 0.03;
};

// Returns a function that connects the board to a machine; the board must outlive it.
ConnectDevice connection_to(auto& device) {
  return [&device](EmulatedMachine& machine, std::span<const drivers::Transmission> transmissions) {
    device.connect(machine, transmissions);
  };
}

void emulate_falcon(const FalconOptions& options) {
  FalconGadget gadget({.firmware_loaded = options.firmware_bytes == 0,
                       .image_bytes = options.firmware_bytes,
                       .homed = options.homed},
                      options.machine.seed,
                      {.function_fs = options.function_fs,
                       .gadget = options.gadget,
                       .controller = options.controller});
  EmulatedFalcon falcon(gadget);
  emulate(options.machine, fmt::format("a Novint Falcon as USB gadget {}", options.gadget),
          connection_to(falcon));
}

void emulate_haply(const HaplyOptions& options) {
  if (options.pty == !options.tty.empty()) {
    throw InputError("say where: either --tty /dev/ttyGS0, the tty of a USB gadget, or --pty");
  }
  std::optional<UsbPlug> plug;
  if (!options.gadget.empty()) {
    plug.emplace(options.gadget, options.controller);
  }
  SerialDevice port;
  std::string place = options.tty;
  if (options.pty) {
    place = port.open_pseudo_terminal();
  } else {
    port.open(options.tty);
  }
  HaplyEmulator board(port, options.machine.seed);
  EmulatedHaply haply(board, plug ? &*plug : nullptr);
  emulate(options.machine, fmt::format("a Haply board on {}", place), connection_to(haply));
}

// Returns the value of one of two names. Throws InputError that names the option for any other.
template <class Value>
Value named(const std::string& name, const char* option, const char* first_name, Value first,
            const char* second_name, Value second) {
  if (name != first_name && name != second_name) {
    throw InputError(fmt::format("{}: there is no '{}'; there are: {}, {}", option, name,
                                 first_name, second_name));
  }
  return name == first_name ? first : second;
}

drivers::GpioAxisConfig paddle_config(const PaddleOptions& options) {
  using drivers::BridgeMode;
  using drivers::TorqueLaw;
  drivers::GpioAxisConfig config;
  config.pins = parse_pins(options.pins);
  if (!config.pins.encoder_a || !config.pins.encoder_b) {
    throw InputError("--pins: an encoder has two lines; write encoder_a=0,encoder_b=1");
  }
  config.encoder.counts_per_rev = options.counts;
  config.bridge.mode =
      named(options.bridge, "--bridge", "sign_magnitude", BridgeMode::sign_magnitude,
            "locked_antiphase", BridgeMode::locked_antiphase);
  config.bridge.law = named(options.law, "--torque-law", "linear", TorqueLaw::linear, "square_root",
                            TorqueLaw::square_root);
  config.bridge.full_duty_torque_Nm = options.full_torque_Nm;
  config.bridge.max_torque_Nm = options.full_torque_Nm;
  return config;
}

void emulate_paddle(const PaddleOptions& options) {
  constexpr std::size_t kLines = 64;
  // 10,000 edges a second, about as many as gpio-sim passes on without loss. A faster shaft is then
  // ahead of its encoder.
  constexpr std::uint32_t kStepsPerRun = 1;
  const drivers::GpioAxisConfig config = paddle_config(options);
  GpioSimPins pins(options.chip, options.chip, kLines, options.pwm);
  GpioAxisEmulator axis(config, pins, options.machine.seed, kStepsPerRun);
  EmulatedPaddle paddle(axis);
  emulate(options.machine,
          fmt::format("a paddle on the GPIO chip {} and the PWM channel {}/pwmchip0/pwm0",
                      options.chip, options.pwm),
          connection_to(paddle));
}

// Adds the verb of one board. The options live as long as the verb's callback, which holds them.
template <class Options>
std::pair<CLI::App*, Options*> add_board(CLI::App& emulate, const char* name, const char* text,
                                         const char* mechanism, void (*run)(const Options&)) {
  const auto options = std::make_shared<Options>();
  CLI::App* const verb = emulate.add_subcommand(name, text);
  options->machine.mechanism = mechanism;
  add_machine_options(*verb, options->machine);
  verb->callback([options, run] {
    take_emulator_priority(options->machine);
    run(*options);
  });
  return {verb, options.get()};
}

void add_falcon(CLI::App& emulate) {
  const auto [verb, options] = add_board<FalconOptions>(
      emulate, "falcon", "Novint Falcon as a USB gadget", "falcon", emulate_falcon);
  verb->add_option("--function-fs", options->function_fs, "Where its FunctionFS is mounted")
      ->capture_default_str();
  verb->add_option("--gadget", options->gadget, "The gadget's folder")->capture_default_str();
  verb->add_option("--controller", options->controller, "One of /sys/class/udc")
      ->capture_default_str();
  verb->add_option("--needs-firmware", options->firmware_bytes,
                   "Without firmware at first; its loader waits for an image of so many bytes");
  verb->add_flag("--homed", options->homed,
                 "With its reference from the start; default: when the hand has pulled the grip "
                 "out and pushed it in");
}

void add_haply(CLI::App& emulate) {
  const auto [verb, options] = add_board<HaplyOptions>(
      emulate, "haply", "Haply board on a serial line", "haply_pantograph", emulate_haply);
  verb->add_option("--tty", options->tty, "The device's end, like a gadget's /dev/ttyGS0");
  verb->add_flag("--pty", options->pty, "Make a pseudo-terminal and say its path");
  verb->add_option("--gadget", options->gadget,
                   "The gadget's folder, to plug it in and out; default: it is plugged in");
  verb->add_option("--controller", options->controller, "One of /sys/class/udc")
      ->capture_default_str();
}

void add_paddle(CLI::App& emulate) {
  const auto [verb, options] = add_board<PaddleOptions>(
      emulate, "paddle", "One axis on the kernel's gpio-sim lines", "hapkit", emulate_paddle);
  verb->add_option("--chip", options->chip, "Makes a GPIO chip of this label")
      ->capture_default_str();
  verb->add_option("--pwm", options->pwm, "Folder to lay out as /sys/class/pwm, a tmpfs")
      ->capture_default_str();
  verb->add_option("--pins", options->pins,
                   "NAME=LINE or NAME=LINE:active_low; names as in device.toml")
      ->delimiter(',')
      ->capture_default_str();
  verb->add_option("--counts", options->counts, "Encoder counts a turn of the shaft, all edges")
      ->check(CLI::Range(4, 10'000'000))
      ->capture_default_str();
  verb->add_option("--bridge", options->bridge, "sign_magnitude or locked_antiphase")
      ->capture_default_str();
  verb->add_option("--torque-law", options->law, "linear or square_root")->capture_default_str();
  verb->add_option("--max-torque", options->full_torque_Nm, "At full duty, N m at the shaft")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

}  // namespace

void add_emulated_boards(CLI::App& emulate) {
  add_falcon(emulate);
  add_haply(emulate);
  add_paddle(emulate);
}

}  // namespace tactus::host
