#include "drivers/falcon_usb/falcon.h"

#include <algorithm>
#include <cmath>

namespace tactus::drivers {

namespace {

// A read without a believable answer counts kFalconBadRead, a good one takes 1 back: three bad ones
// in a row are a fault, and so is any mix in the long run of which a quarter is bad.
constexpr std::uint32_t kFalconBadRead = 3;
constexpr std::uint32_t kFalconFaultScore = 9;
constexpr std::uint32_t kFalconBlockedToLoss = 3;
// The origin moves when the reference is found: so many equal answers before it is believed.
constexpr std::uint32_t kFalconHomedToBelieve = 8;
constexpr int kFalconCountsOfSlack = 4;
constexpr hal::TimeNs kFalconLongestGap_ns = 10'000'000;
constexpr hal::TimeNs kFalconRequestPatience_ns = 20'000'000;
constexpr hal::TimeNs kFalconFarewellPatience_ns = 20'000'000;
constexpr std::size_t kFalconPacketsATick = 16;

constexpr Trouble kFalconUnplugged{
    .what = "the Falcon is unplugged",
    .remedy = "plug in its USB cable and its power supply, then reset"};
constexpr Trouble kFalconTransferFailed{.what = "a USB transfer to the Falcon failed",
                                        .remedy = "check the cable, leave out hubs, then reset"};
constexpr Trouble kFalconSilent{.what = "the Falcon does not answer",
                                .remedy = "check its power supply and the host's load, then reset"};
constexpr Trouble kFalconNotTaking{.what = "the Falcon takes no more packets",
                                   .remedy = "switch it off and on, then reset"};
constexpr Trouble kFalconGarbled{.what = "the Falcon's packets arrive damaged",
                                 .remedy = "check the cable, leave out hubs, then reset"};
constexpr Trouble kFalconJumped{
    .what = "the Falcon's arms seem to jump",
    .remedy = "check the cable; reset, pull the grip out and push it in"};
constexpr Trouble kFalconReferenceLost{
    .what = "the Falcon lost its reference",
    .remedy = "check its power supply; reset, pull the grip out and push it in"};

Trouble trouble_of(FalconBringUp::Outcome outcome) {
  switch (outcome) {
    case FalconBringUp::Outcome::refuses_settings:
      return {.what = "the Falcon refuses its serial settings",
              .remedy = "unplug it, plug it in again, then reset"};
    case FalconBringUp::Outcome::no_firmware:
      return {.what = "the Falcon has no firmware",
              .remedy = "give the firmware file of its maker's software, then reset"};
    case FalconBringUp::Outcome::no_loader:
      return {.what = "the Falcon's firmware loader does not answer",
              .remedy = "switch it off and on, then reset"};
    case FalconBringUp::Outcome::load_failed:
      return {.what = "the Falcon did not take the firmware",
              .remedy = "leave out hubs, switch it off and on, then reset"};
    case FalconBringUp::Outcome::firmware_silent:
      return {.what = "the Falcon took the firmware and does not answer",
              .remedy = "check that the file is a firmware image for it, then reset"};
    case FalconBringUp::Outcome::under_way:
    case FalconBringUp::Outcome::up:
      break;
  }
  return {};
}

double arm_angle_rad(std::int16_t counts) {
  return kFalconZeroRad + counts * kFalconRadPerCount;
}

}  // namespace

Falcon::Falcon(hal::UsbEndpoint& endpoint, const hal::Clock& clock, const FalconConfig& config)
    : endpoint_(&endpoint),
      clock_(&clock),
      config_(config),
      bring_up_(config.firmware),
      rates_{RateFilter(config.velocity_cutoff_Hz), RateFilter(config.velocity_cutoff_Hz),
             RateFilter(config.velocity_cutoff_Hz)} {}

Falcon::~Falcon() {
  withdraw_all();
}

void Falcon::start() {
  withdraw_all();
  reader_.restart();
  next_read_ = 0;
  sent_ = 0;
  answered_ = 0;
  payload_bytes_ = 0;
  samples_ = {};
  homed_ = false;
  homed_in_a_row_ = 0;
  bad_score_ = 0;
  blocked_in_a_row_ = 0;
  buttons_ = 0;
  motors_ = {};
  latched_ = kDeviceOk;
  trouble_ = {};
  state_ = State::coming_up;
  bring_up_.start(clock_->now_ns());
  for (Read& read : reads_) {
    submit(read.transfer);
  }
}

void Falcon::clear_faults() {
  if (endpoint_->state() == hal::UsbState::returned) {
    (void)endpoint_->reopen();  // if it fails, starting says so
  }
  start();
}

void Falcon::stop() {
  if (state_ == State::running) {
    check_writes();
    Write& write = writes_[next_write_];
    send({.motor = {}, .lights = {.red = true}});
    (void)endpoint_->wait(write.transfer, clock_->now_ns() + kFalconFarewellPatience_ns);
  }
  withdraw_all();
  state_ = State::stopped;
}

void Falcon::withdraw_all() {
  for (Read& read : reads_) {
    endpoint_->cancel(read.transfer);
  }
  for (Write& write : writes_) {
    endpoint_->cancel(write.transfer);
    write.on_its_way = false;
  }
}

void Falcon::read(std::span<AxisSample> samples, hal::TimeNs deadline_ns) {
  fresh_ = false;
  payload_ = false;
  doubt_ = {};
  if ((latched_ & kDeviceLost) != 0) {
    if (endpoint_->state() != hal::UsbState::attached) {
      trouble_ = kFalconUnplugged;
    }
    drain();
  } else if (state_ == State::coming_up) {
    come_up(deadline_ns);
  } else if (state_ == State::running) {
    exchange(deadline_ns);
  }
  const std::uint32_t now_status = status();
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    samples_[arm].status = now_status;
    samples[arm] = samples_[arm];
  }
}

std::uint32_t Falcon::status() const {
  if (state_ != State::running) {
    return latched_ | kDeviceNotReady;
  }
  return latched_ | (homed_ ? kDeviceOk : kDeviceHoming) | (fresh_ ? kDeviceOk : kDeviceStale);
}

Trouble Falcon::trouble(std::size_t /*axis*/) const {
  return trouble_;
}

void Falcon::latch(std::uint32_t status, const Trouble& trouble) {
  latched_ |= status;
  if (!trouble_) {
    trouble_ = trouble;
  }
}

void Falcon::lose(const hal::Error& error) {
  Trouble trouble =
      error.code == hal::ErrorCode::disconnected || error.code == hal::ErrorCode::invalid_state
          ? kFalconUnplugged
          : kFalconTransferFailed;
  trouble.code = static_cast<std::uint32_t>(-error.errno_value);
  latch(kDeviceLost, trouble);
}

void Falcon::come_up(hal::TimeNs deadline_ns) {
  const hal::TimeNs now_ns = clock_->now_ns();
  drain();
  while (act(bring_up_.next(now_ns))) {
  }
  (void)receive(deadline_ns);
  note_outcome();
}

// True if there may be more to do at once.
bool Falcon::act(const FalconBringUp::Action& action) {
  using Kind = FalconBringUp::Action::Kind;
  if (action.kind == Kind::nothing || latched_ != kDeviceOk) {
    return false;
  }
  const hal::TimeNs by_ns = clock_->now_ns() + kFalconRequestPatience_ns;
  const auto done = action.kind == Kind::control ? endpoint_->control_out(action.setup, {}, by_ns)
                                                 : endpoint_->bulk_out(action.bytes, by_ns);
  if (done && (action.kind == Kind::control || *done == action.bytes.size())) {
    return action.kind == Kind::send;
  }
  if (!done && done.error().code != hal::ErrorCode::timeout &&
      done.error().code != hal::ErrorCode::stalled) {
    lose(done.error());
  }
  bring_up_.refused(clock_->now_ns());
  return false;
}

void Falcon::note_outcome() {
  if (bring_up_.outcome() == FalconBringUp::Outcome::up) {
    state_ = State::running;
    reader_.restart();
  } else if (const Trouble failed = trouble_of(bring_up_.outcome()); failed) {
    latch(kDeviceDriveFault, failed);
  }
}

void Falcon::drain() {
  for (std::size_t i = 0; i < kFalconPacketsATick && receive(hal::kNoWait); ++i) {
  }
}

void Falcon::exchange(hal::TimeNs deadline_ns) {
  const bool awaited = sent_ != answered_;
  drain();
  for (std::size_t i = 0; i < kFalconPacketsATick && awaited && !fresh_ && !doubt_; ++i) {
    if (!receive(deadline_ns)) {
      break;
    }
  }
  if (awaited || doubt_) {
    judge();
  }
}

void Falcon::judge() {
  if (fresh_) {
    bad_score_ -= bad_score_ > 0 ? 1 : 0;
    return;
  }
  bad_score_ += kFalconBadRead;
  if (bad_score_ < kFalconFaultScore) {
    return;
  }
  if (doubt_) {
    latch(kDeviceEncoderFault, doubt_);
  } else if (payload_) {
    latch(kDeviceEncoderFault, kFalconGarbled);
  } else {
    latch(kDeviceLost, kFalconSilent);
  }
}

bool Falcon::receive(hal::TimeNs deadline_ns) {
  Read& read = reads_[next_read_];
  if (read.transfer.state() == hal::UsbTransfer::State::idle) {
    return false;
  }
  const auto got = endpoint_->wait(read.transfer, deadline_ns);
  if (read.transfer.state() == hal::UsbTransfer::State::in_flight) {
    return false;
  }
  if (!got) {
    lose(got.error());
    return false;
  }
  take(ftdi_payload(std::span(read.buffer).first(*got)));
  submit(read.transfer);
  next_read_ = (next_read_ + 1) % reads_.size();
  return true;
}

void Falcon::take(std::span<const std::byte> payload) {
  if (state_ != State::running) {
    bring_up_.take(payload, clock_->now_ns());
    return;
  }
  payload_ = payload_ || !payload.empty();
  for (const std::byte byte : payload) {
    if (++payload_bytes_ % kFalconPacketBytes == 0 && answered_ != sent_) {
      answer_ns_ = sent_ns_[answered_ % kRemembered];
      ++answered_;
    }
    if (const auto reply = reader_.take(byte)) {
      accept(*reply);
    }
  }
}

void Falcon::accept(const FalconReply& reply) {
  if (latched_ != kDeviceOk || sent_ == 0) {
    return;
  }
  if (!homed_) {
    home_with(reply);
  } else if (!reply.all_homed()) {
    doubt_ = kFalconReferenceLost;
  } else if (!moved_plausibly(reply)) {
    doubt_ = kFalconJumped;
  } else {
    believe(reply);
  }
}

void Falcon::home_with(const FalconReply& reply) {
  const bool steady = homed_in_a_row_ == 0 || moved_plausibly(reply);
  homed_in_a_row_ = reply.all_homed() && steady ? homed_in_a_row_ + 1 : 0;
  homed_ = homed_in_a_row_ >= kFalconHomedToBelieve;
  believe(reply);
}

void Falcon::believe(const FalconReply& reply) {
  fresh_ = true;
  if (answer_ns_ != believed_.time_ns) {
    reference_ = believed_;
  }
  believed_ = {.counts = reply.counts, .time_ns = answer_ns_};
  buttons_ = reply.buttons;
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    if (homed_in_a_row_ == 0) {
      rates_[arm].restart();
    }
    AxisSample& sample = samples_[arm];
    sample.position_rad = arm_angle_rad(reply.counts[arm]);
    sample.velocity_rad_per_s = std::clamp(rates_[arm].update(sample.position_rad, answer_ns_),
                                           -config_.fastest_rad_per_s, config_.fastest_rad_per_s);
    sample.time_ns = answer_ns_;
  }
}

bool Falcon::moved_plausibly(const FalconReply& reply) const {
  const Believed& from = answer_ns_ != believed_.time_ns ? believed_ : reference_;
  const hal::TimeNs gap_ns =
      std::clamp<hal::TimeNs>(answer_ns_ - from.time_ns, 0, kFalconLongestGap_ns);
  const double reach_rad = config_.fastest_rad_per_s * static_cast<double>(gap_ns) * 1e-9;
  const int reach = kFalconCountsOfSlack + static_cast<int>(reach_rad / kFalconRadPerCount);
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    if (std::abs(int{reply.counts[arm]} - int{from.counts[arm]}) > reach) {
      return false;
    }
  }
  return true;
}

void Falcon::write(std::span<const AxisCommand> commands) {
  if (state_ != State::running) {
    return;
  }
  check_writes();
  const bool allowed = latched_ == kDeviceOk && homed_;
  FalconCommand command;
  bool powered = false;
  for (std::size_t arm = 0; arm < kFalconArms; ++arm) {
    command.motor[arm] = allowed ? motor_units(commands[arm]) : std::int16_t{0};
    powered = powered || (allowed && commands[arm].enable);
  }
  command.lights = lights(powered);
  send(command);
}

// A positive motor value pulls the arm toward the base: the sign of both sources.
std::int16_t Falcon::motor_units(const AxisCommand& command) const {
  if (!command.enable || !std::isfinite(command.torque_Nm)) {
    return 0;
  }
  const double torque_Nm =
      std::clamp(command.torque_Nm, -config_.torque_limit_Nm, config_.torque_limit_Nm);
  const double limit = kFalconMotorLimit;
  const double units = std::clamp(-config_.motor_units_per_Nm * torque_Nm, -limit, limit);
  return static_cast<std::int16_t>(units);
}

FalconLights Falcon::lights(bool powered) const {
  const bool well = homed_ && latched_ == kDeviceOk;
  return {.red = !well, .green = well && !powered, .blue = well && powered};
}

// Whether the packets before arrived.
void Falcon::check_writes() {
  for (Write& write : writes_) {
    if (!write.on_its_way) {
      continue;
    }
    const auto sent = endpoint_->wait(write.transfer, hal::kNoWait);
    write.on_its_way = write.transfer.state() == hal::UsbTransfer::State::in_flight;
    if (!sent && !write.on_its_way) {
      lose(sent.error());
    }
  }
}

void Falcon::send(const FalconCommand& command) {
  Write& write = writes_[next_write_];
  if (write.on_its_way) {
    ++blocked_in_a_row_;
    if (blocked_in_a_row_ >= kFalconBlockedToLoss) {
      latch(kDeviceLost, kFalconNotTaking);
    }
    return;
  }
  blocked_in_a_row_ = 0;
  write.packet = encode(command);
  motors_ = command.motor;
  if (sent_ - answered_ == kRemembered) {
    ++answered_;
  }
  sent_ns_[sent_ % kRemembered] = clock_->now_ns();
  ++sent_;
  next_write_ = (next_write_ + 1) % writes_.size();
  write.on_its_way = true;
  submit(write.transfer);
}

void Falcon::submit(hal::UsbTransfer& transfer) {
  if (const auto submitted = endpoint_->submit(transfer); !submitted) {
    lose(submitted.error());
  }
}

}  // namespace tactus::drivers
