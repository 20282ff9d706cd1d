#include "firmware/linux/tactusd/options.h"

#include <cstdlib>
#include <string_view>

#include "firmware/limits.h"
#include "firmware/linux/tactusd/image_kind.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/telemetry/run_recorder.h"

namespace tactus::firmware {

namespace {

// Reads a number in the closed range. Returns false if the text is missing or is anything else.
bool read_number(const char* text, double low, double high, double& number) {
  char* end = nullptr;
  number = text == nullptr ? 0.0 : std::strtod(text, &end);
  return end != nullptr && end != text && *end == '\0' && number >= low && number <= high;
}

// Prints what is wrong with an argument. Returns false for the caller to return.
bool complain(std::string_view what, std::string_view argument) {
  std::fprintf(stderr, "tactusd: %.*s %.*s; see tactusd --help\n", length(what), what.data(),
               length(argument), argument.data());
  return false;
}

// Reads the value of an option. Returns false if the option is unknown or the value is not valid.
bool read_value(std::string_view option, const char* value, Options& options) {
  double number = 0.0;
  if (option == "--record") {
    options.record = value;
    return is_recording_name(value == nullptr ? "" : value) ||
           complain("give a file that ends in .mcap or .csv after", option);
  }
  if (option == "--flight-dir") {
    options.flight_dir = value;
    return value != nullptr || complain("no folder after", option);
  }
  if (option == "--run-dir") {
    options.run_dir = value;
    return value != nullptr || complain("no folder after", option);
  }
  if (option == "--group") {
    options.group = value;
    return value != nullptr || complain("no group after", option);
  }
  if (option == "--udp-json") {
    if (!read_number(value, 1.0, 65535.0, number)) {
      return complain("give a UDP port after", option);
    }
    options.udp_port = static_cast<std::uint16_t>(number);
    return true;
  }
  if (option == "--histogram") {
    options.histogram = value;
    return value != nullptr || complain("no file after", option);
  }
  if (option == "--rate") {
    return read_number(value, kMinRate_Hz, kMaxRate_Hz, options.rate_hz) ||
           complain("give 50 to 50000 ticks a second after", option);
  }
  if (option == "--cpu") {
    if (!read_number(value, 0.0, 1023.0, number)) {
      return complain("give the number of a processor after", option);
    }
    options.cpu = static_cast<int>(number);
    return true;
  }
  if (option == "--seconds") {
    return read_number(value, 0.0, 1e6, options.seconds) ||
           complain("give 0 to 1000000 seconds after", option);
  }
  if (option == "--priority") {
    if (!read_number(value, 1.0, 98.0, number)) {
      return complain("give a priority from 1 to 98 after", option);
    }
    options.priority = static_cast<int>(number);
    return true;
  }
  if (option == "--scene-memory") {
    constexpr double kMostMebibytes = 65536.0;
    if (!read_number(value, 1.0, kMostMebibytes, number)) {
      return complain("give 1 to 65536 mebibytes after", option);
    }
    options.scene_memory_bytes = static_cast<std::size_t>(number) << 20U;
    return true;
  }
  return complain("unknown option", option);
}

// Takes an image by its kind. Returns false if there are too many.
bool take_image(const char* path, Options& options) {
  if (is_scene_image(path)) {
    if (options.scene != nullptr) {
      return complain("one scene is all that fits; another one is", path);
    }
    options.scene = path;
    return true;
  }
  if (options.device_count == options.devices.size()) {
    return complain("ten devices are all that fit; too much is", path);
  }
  options.devices[options.device_count] = path;
  ++options.device_count;
  return true;
}

}  // namespace

void print_usage(std::FILE* file) {
  std::fputs(
      "usage: tactusd DEVICE.tactus... [SCENE.tactus] [option]...\n"
      "Runs the controller on the boards of one device, or of up to ten in one scene: CAN, USB,\n"
      "serial ports and GPIO of this machine.\n"
      "All images come from `tactus bake`; without a scene the tools move in free space.\n"
      "\n"
      "  --enable              home and enable as soon as the device is ready\n"
      "  --seconds S           end after S seconds; default: at Ctrl-C, or when its\n              "
      "          terminal goes\n"
      "  --record FILE         write every tick to an MCAP file, or as CSV if the name ends in "
      ".csv;\n"
      "                        of several devices to FILE.mcap, FILE.2.mcap, ...; one that is "
      "there is kept\n"
      "  --overwrite           let --record replace files that are there\n"
      "  --flight-dir DIR      after a fault, and at SIGUSR1, write the last seconds there; "
      "default:\n"
      "                        this folder. tactus replay lives them once more\n"
      "  --run-dir DIR         put the sockets there, and those of the second device into DIR/2; "
      "default\n"
      "                        /run/tactus\n"
      "  --group GROUP         the group that may command; default the program's own\n"
      "  --udp-json PORT       send ticks as JSON to this UDP port of this machine, 100 a second;\n"
      "                        PlotJuggler listens at 9870; the second device sends to PORT + "
      "1\n"
      "  --rate HZ             ticks a second in place of the device's own\n"
      "  --scene-memory MIB    take scene images of up to so many MiB; default 256. What the scene "
      "in\n"
      "                        use needs is locked in memory, and while `tactus scene` reads "
      "another\n"
      "                        what that one needs, too\n"
      "  --histogram FILE      write how long wake-up, tick and stages took to a CSV file at the "
      "end\n"
      "  --priority P          SCHED_FIFO priority of the loop, 1 to 98; default 80\n"
      "  --cpu N               run the loop on processor N only\n"
      "  --allow-non-realtime  run even where real-time priority is not to be had\n"
      "  --allow-inject        let `tactus inject` raise faults, for tests and drills\n"
      "  --allow-uncertified   load a scene that is stiffer than the device's certificate\n"
      "  --allow-uncommissioned  enable a device that tactus commission has not passed\n"
      "  --help\n"
      "  --version\n"
      "\n"
      "Exit codes: 0 ended as asked, 1 a fault stopped the motors, 2 could not start.\n"
      "\n"
      "Examples:\n"
      "  tactus bake arm.toml && tactus bake bunny.toml\n"
      "  tactusd arm.tactus bunny.tactus --enable\n"
      "  tactusd arm.tactus bunny.tactus --enable --record run.mcap\n"
      "  tactusd left.tactus right.tactus grasp.tactus --enable\n",
      file);
}

bool parse_options(int argc, const char* const* argv, Options& options) {
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i];
    if (argument == "--help" || argument == "-h") {
      options.help = true;
      return true;
    }
    if (argument == "--version") {
      options.version = true;
      return true;
    }
    if (argument == "--enable") {
      options.enable = true;
    } else if (argument == "--overwrite") {
      options.overwrite = true;
    } else if (argument == "--allow-non-realtime") {
      options.allow_non_realtime = true;
    } else if (argument == "--allow-inject") {
      options.allow_inject = true;
    } else if (argument == "--allow-uncertified") {
      options.allow_uncertified = true;
    } else if (argument == "--allow-uncommissioned") {
      options.allow_uncommissioned = true;
    } else if (argument.starts_with("--")) {
      const char* value = i + 1 < argc ? argv[i + 1] : nullptr;
      ++i;
      if (!read_value(argument, value, options)) {
        return false;
      }
    } else if (!take_image(argv[i], options)) {
      return false;
    }
  }
  if (options.device_count == 0) {
    return complain("give a device image", "");
  }
  if (options.udp_port + options.device_count - 1 > 65535 && options.udp_port != 0) {
    return complain("each device needs a UDP port after", "--udp-json");
  }
  return true;
}

}  // namespace tactus::firmware
