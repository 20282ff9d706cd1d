// Reads or writes one object of a drive at a time, and repeats a question once if no answer comes.
#pragma once

#include <cstdint>

#include "drivers/can_drive.h"
#include "drivers/cia402_can/sdo.h"
#include "hal/clock.h"

namespace tactus::drivers::canopen {

class SdoClient {
 public:
  enum class State : std::uint8_t {
    idle,
    asking,      // waits for the answer
    done,        // value()
    refused,     // value() is the abort code
    too_long,    // the answer would be segmented; the client aborted the transfer
    unanswered,  // no answer, also not to the repeated question
  };

  SdoClient(std::uint8_t node, hal::TimeNs timeout_ns) : node_(node), timeout_ns_(timeout_ns) {}

  // These begin a question. One that is still open is dropped.
  void read(ObjectAddress object);
  void write(ObjectAddress object, std::uint32_t value, std::uint8_t size);
  void reset() { state_ = State::idle; }

  // Takes a frame of the drive. Answers to other questions are ignored.
  void take(const hal::CanFrame& frame);
  // Adds the frames that are due to the outbox.
  void run(hal::TimeNs now_ns, CanOutbox& outbox);

  [[nodiscard]] State state() const { return state_; }
  [[nodiscard]] std::uint32_t value() const { return value_; }

 private:
  void ask(const hal::CanFrame& question, ObjectAddress object, bool is_read);

  std::uint8_t node_;
  hal::TimeNs timeout_ns_;
  State state_ = State::idle;
  hal::CanFrame question_;
  ObjectAddress object_;
  bool is_read_ = false;
  bool owes_abort_ = false;
  std::uint8_t asked_ = 0;  // times
  hal::TimeNs asked_ns_ = 0;
  std::uint32_t value_ = 0;
};

}  // namespace tactus::drivers::canopen
