#include "host_tools/emulators/can_emulator.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {

namespace {

constexpr std::array<std::pair<std::string_view, EmulatorFault>, 7> kFaultNames = {{
    {"none", EmulatorFault::none},
    {"silent", EmulatorFault::silent},
    {"delayed", EmulatorFault::delayed},
    {"corrupted", EmulatorFault::corrupted},
    {"erroring", EmulatorFault::erroring},
    {"unplugged", EmulatorFault::unplugged},
    {"power_cycled", EmulatorFault::power_cycled},
}};

// Inverts one bit of the payload, as a bus error that the checksum missed would.
void flip_a_bit(hal::CanFrame& frame, std::mt19937& random) {
  if (frame.remote || frame.length == 0) {
    return;
  }
  std::uniform_int_distribution<unsigned> bit(0U, frame.length * 8U - 1U);
  const unsigned at = bit(random);
  frame.data[at / 8U] ^= static_cast<std::byte>(1U << (at % 8U));
}

}  // namespace

EmulatorFault emulator_fault(std::string_view name) {
  for (const auto& [known, fault] : kFaultNames) {
    if (known == name) {
      return fault;
    }
  }
  throw InputError("no fault '" + std::string(name) +
                   "'; there are: none, silent, delayed, corrupted, erroring, unplugged, "
                   "power_cycled");
}

EmulatedEncoder emulated_encoder(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, EmulatedEncoder>, 3> kEncoders = {{
      {"incremental", EmulatedEncoder::incremental},
      {"absolute", EmulatedEncoder::absolute},
      {"multi_turn", EmulatedEncoder::multi_turn},
  }};
  for (const auto& [known, encoder] : kEncoders) {
    if (known == name) {
      return encoder;
    }
  }
  throw InputError("no encoder '" + std::string(name) +
                   "'; there are: incremental, absolute, multi_turn");
}

double turns_forgotten(EmulatedEncoder encoder, double turns) {
  switch (encoder) {
    case EmulatedEncoder::incremental:
      return turns;
    case EmulatedEncoder::absolute:
      return std::floor(turns);
    case EmulatedEncoder::multi_turn:
      break;
  }
  return 0.0;
}

void CanEmulator::run(hal::TimeNs now_ns) {
  std::array<hal::CanReceived, 8> received;  // few arrive between two runs
  const bool hears = has_power(now_ns);
  while (const auto count = bus_.receive(received, hal::kNoWait)) {
    for (std::size_t i = 0; hears && i < *count; ++i) {
      if (received[i].kind == hal::CanReceived::Kind::frame) {
        take(now_ns, received[i].frame);
      }
    }
  }
  if (!hears) {
    waiting_.clear();
    shaft_.torque_Nm = 0.0;
    return;
  }
  advance(now_ns, fault_ == EmulatorFault::erroring);
  send_what_is_due(now_ns);
}

bool CanEmulator::has_power(hal::TimeNs now_ns) {
  if (fault_ == EmulatorFault::power_cycled && !is_cycling_) {
    is_cycling_ = true;
    off_until_ns_ = now_ns + kPowerCycle_ns;
  }
  return fault_ != EmulatorFault::unplugged && (!is_cycling_ || now_ns >= off_until_ns_);
}

void CanEmulator::send(hal::TimeNs now_ns, const hal::CanFrame& frame) {
  if (fault_ == EmulatorFault::silent) {
    return;
  }
  Waiting& late = waiting_.emplace_back(
      Waiting{now_ns + (fault_ == EmulatorFault::delayed ? kFaultDelay_ns : 0), frame});
  if (fault_ == EmulatorFault::corrupted) {
    flip_a_bit(late.frame, random_);
  }
}

// A full transmit queue is no error: the frame stays in front and is sent in a later run.
void CanEmulator::send_what_is_due(hal::TimeNs now_ns) {
  while (!waiting_.empty() && waiting_.front().due_ns <= now_ns) {
    if (!bus_.send(waiting_.front().frame)) {
      return;
    }
    waiting_.pop_front();
  }
}

}  // namespace tactus::host
