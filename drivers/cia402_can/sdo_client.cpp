#include "drivers/cia402_can/sdo_client.h"

namespace tactus::drivers::canopen {

namespace {

constexpr std::uint8_t kTimesToAsk = 2;

}  // namespace

void SdoClient::read(ObjectAddress object) {
  ask(sdo_read(node_, object), object, true);
}

void SdoClient::write(ObjectAddress object, std::uint32_t value, std::uint8_t size) {
  ask(sdo_write(node_, object, value, size), object, false);
}

void SdoClient::ask(const hal::CanFrame& question, ObjectAddress object, bool is_read) {
  question_ = question;
  object_ = object;
  is_read_ = is_read;
  owes_abort_ = false;
  asked_ = 0;
  state_ = State::asking;
}

void SdoClient::take(const hal::CanFrame& frame) {
  const auto answer = sdo_answer_of(frame, node_);
  if (!answer || state_ != State::asking || asked_ == 0 || answer->object != object_) {
    return;
  }
  value_ = answer->value;
  switch (answer->kind) {
    case SdoAnswer::Kind::value:
      state_ = is_read_ ? State::done : State::asking;
      return;
    case SdoAnswer::Kind::written:
      state_ = is_read_ ? State::asking : State::done;
      return;
    case SdoAnswer::Kind::abort:
      state_ = State::refused;
      return;
    case SdoAnswer::Kind::segmented:
      state_ = State::too_long;
      owes_abort_ = true;
      return;
    case SdoAnswer::Kind::malformed:
      return;
  }
}

void SdoClient::run(hal::TimeNs now_ns, CanOutbox& outbox) {
  if (owes_abort_) {
    owes_abort_ = !outbox.add(sdo_abort(node_, object_, kAbortBadCommand));
  }
  if (state_ != State::asking || (asked_ > 0 && now_ns - asked_ns_ < timeout_ns_)) {
    return;
  }
  if (asked_ == kTimesToAsk) {
    state_ = State::unanswered;
    return;
  }
  if (outbox.add(question_)) {
    ++asked_;
    asked_ns_ = now_ns;
  }
}

}  // namespace tactus::drivers::canopen
