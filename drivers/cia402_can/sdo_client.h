// Asks a drive for one object after the other, and repeats a question that got lost once.
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
    asking,      // no answer yet
    done,        // value()
    refused,     // value() is the abort code
    too_long,    // the answer would be segmented: this client aborted the transfer
    unanswered,  // nor to the repeated question
  };

  SdoClient(std::uint8_t node, hal::TimeNs timeout_ns) : node_(node), timeout_ns_(timeout_ns) {}

  // A question that is still open is given up.
  void read(ObjectAddress object);
  void write(ObjectAddress object, std::uint32_t value, std::uint8_t size);
  void reset() { state_ = State::idle; }

  // Answers to what was not asked are ignored.
  void take(const hal::CanFrame& frame);
  // Sends what is to be sent.
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
