// Emulated drives that turn rotors on a simulated CAN bus, and the CanBoard that drives them.
#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/axis.h"
#include "drivers/composition/can_board.h"
#include "hal/simulated/can_bus.h"
#include "hal/simulated/can_network.h"
#include "hal/simulated/clock.h"
#include "host_tools/emulators/can_emulator.h"
#include "tests/unit/drivers/candump.h"

namespace tactus::drivers {

inline constexpr hal::TimeNs kUs = 1'000;
inline constexpr hal::TimeNs kMs = 1'000'000;

// A rigid rotor with viscous friction, turned by the motor and by whoever holds it.
struct Rotor {
  double inertia_kg_m2 = 1e-4;
  double damping_Nm_s = 2e-4;
  double hand_Nm = 0.0;

  void step(host::EmulatedShaft& shaft, double dt_s) const {
    const double torque_Nm = shaft.torque_Nm + hand_Nm - damping_Nm_s * shaft.velocity_rad_per_s;
    shaft.velocity_rad_per_s += dt_s * torque_Nm / inertia_kg_m2;
    shaft.position_rad += dt_s * shaft.velocity_rad_per_s;
  }
};

struct CanRigConfig {
  hal::SimulatedCanNetworkConfig network{.bit_rate = 1'000'000};
  hal::TimeNs period_ns = kMs;        // of the ticks
  hal::TimeNs patience_ns = 600'000;  // for samples, in a tick
  hal::TimeNs step_ns = 50'000;       // of rotors and emulators
  bool record = false;
};

// One axis for each pair of configurations.
template <class Driver, class Emulator>
class CanRig final : private hal::SimulatedEventSource {
 public:
  template <class DriverConfig, class EmulatorConfig>
  CanRig(const CanRigConfig& config, const std::vector<DriverConfig>& drivers,
         const std::vector<EmulatorConfig>& emulators)
      : config_(config), network_(clock_, config.network), host_(network_), listener_(network_) {
    for (std::size_t i = 0; i < drivers.size(); ++i) {
      EXPECT_TRUE(check(drivers[i]));
      EXPECT_TRUE(board_.add(Driver(drivers[i])));
      nodes_.push_back(std::make_unique<hal::SimulatedCanBus>(network_));
      emulators_.push_back(std::make_unique<Emulator>(
          *nodes_.back(), static_cast<std::uint32_t>(i + 1), emulators[i]));
    }
    rotors_.resize(drivers.size());
    last_torque_ns_.resize(drivers.size());
    samples_.resize(drivers.size());
    commands_.resize(drivers.size());
    next_step_ns_ = clock_.now_ns();
    start_ns_ = clock_.now_ns();
    next_tick_ns_ = clock_.now_ns();
    clock_.attach(*this);
  }
  CanRig(const CanRig&) = delete;
  CanRig& operator=(const CanRig&) = delete;
  ~CanRig() { clock_.detach(*this); }

  // Runs ticks for that long. `act(samples, commands)` decides each tick's commands, which stay as
  // they were if it leaves them.
  template <class Act>
  void run(hal::TimeNs duration_ns, Act act) {
    const hal::TimeNs end_ns = next_tick_ns_ + duration_ns;
    while (next_tick_ns_ < end_ns) {
      tick(act);
    }
  }
  void run(hal::TimeNs duration_ns) {
    run(duration_ns, [](auto&, auto&) {});
  }
  // Runs ticks until every axis is well. Returns how long that took, or -1 if it took longer.
  hal::TimeNs run_until_well(hal::TimeNs at_most_ns) {
    const hal::TimeNs begin_ns = next_tick_ns_;
    while (next_tick_ns_ < begin_ns + at_most_ns) {
      tick([](auto&, auto&) {});
      if (are_well()) {
        return next_tick_ns_ - begin_ns;
      }
    }
    return -1;
  }
  // Runs ticks until `done()`. Returns how long that took, or -1 if it took longer.
  template <class Done>
  hal::TimeNs run_until(hal::TimeNs at_most_ns, Done done) {
    const hal::TimeNs begin_ns = clock_.now_ns();
    while (clock_.now_ns() < begin_ns + at_most_ns) {
      tick([](auto&, auto&) {});
      if (done()) {
        return clock_.now_ns() - begin_ns;
      }
    }
    return -1;
  }

  void start() { board_.start(); }
  void command_all(double torque_Nm) {
    for (AxisCommand& command : commands_) {
      command = {.torque_Nm = torque_Nm, .enable = true};
    }
  }
  // Lets time pass without ticks: the drives hear nothing.
  void idle(hal::TimeNs duration_ns) {
    clock_.advance_by(duration_ns);
    next_tick_ns_ = clock_.now_ns();
  }

  CanBoard<Driver>& board() { return board_; }
  hal::SimulatedClock& clock() { return clock_; }
  hal::SimulatedCanBus& host() { return host_; }
  hal::SimulatedCanNetwork& network() { return network_; }
  Emulator& emulator(std::size_t i) { return *emulators_[i]; }
  hal::SimulatedCanBus& node(std::size_t i) { return *nodes_[i]; }
  Rotor& rotor(std::size_t i) { return rotors_[i]; }
  // Returns when the motor last exerted a torque; 0: never.
  hal::TimeNs last_torque_ns(std::size_t i) const { return last_torque_ns_[i]; }
  const AxisSample& sample(std::size_t i) const { return samples_[i]; }
  const Driver& driver(std::size_t i) const {
    const auto* drive = board_.template drive<Driver>(i);
    if (drive == nullptr) {
      throw std::out_of_range("no such axis");
    }
    return *drive;
  }
  const std::vector<std::string>& log() const { return log_; }

  bool are_well() const {
    return std::ranges::all_of(samples_,
                               [](const AxisSample& sample) { return sample.status == kDeviceOk; });
  }

 private:
  template <class Act>
  void tick(Act act) {
    clock_.advance_to(next_tick_ns_);
    board_.read(samples_, clock_.now_ns() + config_.patience_ns);
    act(samples_, commands_);
    board_.write(commands_);
    next_tick_ns_ += config_.period_ns;
    write_log();
  }

  void write_log() {
    std::array<hal::CanReceived, 64> received;
    while (const auto count = listener_.receive(received, hal::kNoWait)) {
      for (const hal::CanReceived& item : std::span(received).first(*count)) {
        if (config_.record) {
          log_.push_back(candump_line(item, start_ns_));
        }
      }
    }
  }

  hal::TimeNs next_event_ns() const override { return next_step_ns_; }
  void run_event() override {
    for (std::size_t i = 0; i < emulators_.size(); ++i) {
      rotors_[i].step(emulators_[i]->shaft(), 1e-9 * static_cast<double>(config_.step_ns));
      emulators_[i]->run(next_step_ns_);
      if (emulators_[i]->shaft().torque_Nm != 0.0) {
        last_torque_ns_[i] = next_step_ns_;
      }
    }
    next_step_ns_ += config_.step_ns;
  }

  CanRigConfig config_;
  hal::SimulatedClock clock_;
  hal::SimulatedCanNetwork network_;
  hal::SimulatedCanBus host_;
  hal::SimulatedCanBus listener_;
  CanBoard<Driver> board_{host_, clock_};
  std::vector<std::unique_ptr<hal::SimulatedCanBus>> nodes_;
  std::vector<std::unique_ptr<Emulator>> emulators_;
  std::vector<Rotor> rotors_;
  std::vector<AxisSample> samples_;
  std::vector<AxisCommand> commands_;
  std::vector<hal::TimeNs> last_torque_ns_;
  std::vector<std::string> log_;
  hal::TimeNs next_step_ns_ = 0;
  hal::TimeNs next_tick_ns_ = 0;
  hal::TimeNs start_ns_ = 0;
};

}  // namespace tactus::drivers
