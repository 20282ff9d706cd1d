// A Haply board as its serial line shows it: its firmware with motors and encoders, on arms that
// the caller's plant turns. The port is the device's end of a simulated line, the master side of a
// pseudo-terminal, or /dev/ttyGS0 of a gadget.
//
// It fakes the byte parser with its habits (a byte that has not arrived reads as 0xFF; a float is
// waited for), setup and reset, encoder presets, whole counts, the torque clamp, and motors that
// keep their torque. It does not fake analogue inputs (they read 0), PWM outputs, and the time-out
// of a float after one second.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <random>
#include <vector>

#include "hal/clock.h"
#include "hal/serial_port.h"
#include "host_tools/emulators/emulator_fault.h"
#include "host_tools/emulators/shaft.h"

namespace tactus::host {

// One board. One thread.
class HaplyEmulator {
 public:
  static constexpr std::size_t kPorts = 4;

  // The port must outlive the emulator. `seed` chooses the bits that `corrupted` inverts.
  HaplyEmulator(hal::SerialPort& port, std::uint32_t seed) : port_(port), random_(seed) {}

  // Handles the bytes that have arrived and sends what is due. Call it at least ten times a
  // millisecond: the firmware polls every 50 us.
  void run(hal::TimeNs now_ns);

  // The arm at each port; the plant writes angles and reads torques.
  [[nodiscard]] std::array<EmulatedShaft, kPorts>& shafts() { return shafts_; }

  // Sets a fault. `erroring`: the board restarts by itself, as after a dip of its supply, and has
  // lost its setup. `power_cycled`: the same after kPowerCycle_ns without power.
  void set_fault(EmulatorFault fault);
  [[nodiscard]] EmulatorFault fault() const { return fault_.kind(); }

  // Returns how many motors the host has set up.
  [[nodiscard]] std::size_t motors() const { return setup_.motor_reversed.size(); }
  // Return how many setups, torque commands and unknown commands have arrived.
  [[nodiscard]] std::uint64_t setups() const { return counts_.setups; }
  [[nodiscard]] std::uint64_t commands() const { return counts_.torque_commands; }
  [[nodiscard]] std::uint64_t unknown_commands() const { return counts_.unknown_commands; }

 private:
  // An encoder as the host has set it up.
  struct EncoderSetup {
    bool reversed = false;
    double preset_deg = 0.0;
    double counts_per_turn = 1.0;
    double angle_at_setup_rad = 0.0;
  };
  // The motors and encoders that are connected to the board, and the numbers of analogue inputs and
  // PWM outputs.
  struct Setup {
    std::vector<bool> motor_reversed;
    std::vector<EncoderSetup> encoders;
    std::size_t analogue = 0;
    std::size_t pwm = 0;
  };
  // The rest of the command that the parser waits for.
  enum class Waiting : std::uint8_t { nothing, setup_floats, torques };
  // A command that is being received.
  struct Command {
    Waiting waits_for = Waiting::nothing;
    // The device's number, which stands in every command and answer.
    std::uint8_t device_id = 0;
    // The setup that the command makes, if it is one.
    Setup setup;
  };
  // The numbers of commands of each kind that have arrived.
  struct Counts {
    std::uint64_t setups = 0;
    std::uint64_t torque_commands = 0;
    std::uint64_t unknown_commands = 0;
  };
  // An answer that waits to be sent.
  struct Late {
    hal::TimeNs due_ns = 0;
    std::vector<std::byte> bytes;
  };

  // Takes what has arrived at the port.
  void hear();
  // Reads the start of a command. A reset is complete with it and is carried out.
  void start_command();
  // Reads the part of a setup before the floats.
  void start_setup();
  // Carries out the command once all its floats are there; returns false while it waits for them.
  bool finish_command(hal::TimeNs now_ns);
  // Takes over the setup; encoders count from where the shafts are now.
  void finish_setup();
  // Sets the torques and answers.
  void obey(hal::TimeNs now_ns);
  // Queues the answer: the device's number, the analogue inputs (0) and the encoders' angles in
  // degrees.
  void answer(hal::TimeNs now_ns);
  // Forgets the setup and what has arrived, and takes the torques away.
  void restart();

  // Returns the next byte, or 0xFF if none has arrived, as the firmware's read does.
  std::uint8_t byte_if_there();
  // Returns true if `count` floats have arrived.
  [[nodiscard]] bool floats_are_there(std::size_t count) const {
    return heard_.size() >= 4 * count;
  }
  // Returns the next float; four bytes must have arrived.
  double next_float();

  hal::SerialPort& port_;
  std::mt19937 random_;
  ActiveFault fault_;
  std::array<EmulatedShaft, kPorts> shafts_{};
  // The bytes that have arrived and are not yet parsed, and the answers that wait.
  std::deque<std::byte> heard_;
  std::deque<Late> late_;
  Command command_;
  // The setup in use.
  Setup setup_;
  Counts counts_;
};

}  // namespace tactus::host
