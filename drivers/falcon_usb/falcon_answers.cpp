// The part of Falcon that takes the device's answers. It checks when they come, and whether they
// are possible.
#include <algorithm>
#include <cstdlib>

#include "drivers/falcon_usb/falcon.h"
#include "drivers/falcon_usb/falcon_trouble.h"

namespace tactus::drivers {

namespace {

// A read without a possible answer adds kFalconBadRead, a good one subtracts 1. Three bad reads in
// a row are a fault, and so is a long run of which a quarter is bad.
constexpr std::uint32_t kFalconBadRead = 3;
constexpr std::uint32_t kFalconFaultScore = 9;
// The origin moves when the reference is found, so it is trusted after so many equal answers.
constexpr std::uint32_t kFalconHomedToBelieve = 8;
constexpr int kFalconCountsOfSlack = 4;
constexpr hal::TimeNs kFalconLongestGap_ns = 10'000'000;
constexpr std::size_t kFalconPacketsATick = 16;

double arm_angle_rad(std::int16_t counts) {
  return kFalconZeroRad + counts * kFalconRadPerCount;
}

}  // namespace

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
  reference_lost_ = reference_lost_ && !homed_;
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

}  // namespace tactus::drivers
