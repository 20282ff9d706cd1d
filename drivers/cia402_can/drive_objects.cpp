#include "drivers/cia402_can/drive_objects.h"

#include "drivers/common/seconds.h"

namespace tactus::drivers::cia402 {

using canopen::SdoClient;

DriveObjects::DriveObjects(const Cia402Config& config)
    : sdo_(config.node, ns_of(config.sdo_timeout_s)) {}

void DriveObjects::begin_set_up() {
  sdo_.reset();
  step_ = 0;
}

void DriveObjects::restart() {
  sdo_.reset();
  mode_is_set_ = false;
}

DriveObjects::Progress DriveObjects::set_up(const Cia402Config& config, hal::TimeNs now_ns,
                                            CanOutbox& outbox) {
  const auto steps = set_up_steps();
  while (step_ < steps.size()) {
    const Progress progress = run(steps[step_], config, now_ns, outbox);
    if (!progress || !*progress) {
      return progress;
    }
    ++step_;
  }
  return true;
}

DriveObjects::Progress DriveObjects::choose_torque_mode(const Cia402Config& config,
                                                        hal::TimeNs now_ns, CanOutbox& outbox) {
  const Progress progress = run(torque_mode_step(), config, now_ns, outbox);
  mode_is_set_ = progress.value_or(false);
  return progress;
}

DriveObjects::Progress DriveObjects::run(const SdoStep& step, const Cia402Config& config,
                                         hal::TimeNs now_ns, CanOutbox& outbox) {
  if (sdo_.state() == SdoClient::State::idle) {
    if (step.size == 0) {
      sdo_.read(step.object);
    } else {
      sdo_.write(step.object, value_to_write(step, config, facts_), step.size);
    }
  }
  sdo_.run(now_ns, outbox);
  const SdoClient::State state = sdo_.state();
  if (state == SdoClient::State::asking) {
    return false;
  }
  sdo_.reset();
  const bool is_done = state == SdoClient::State::done;
  if (!is_done && (state != SdoClient::State::refused || !may_go_on_without(step, sdo_.value()))) {
    return std::unexpected(refusal(step, state));
  }
  if (const Trouble trouble = judge(step, is_done ? sdo_.value() : 0, config, facts_)) {
    return std::unexpected(Failure{kDeviceDriveFault, trouble});
  }
  return true;
}

DriveObjects::Failure DriveObjects::refusal(const SdoStep& step, SdoClient::State state) const {
  if (state == SdoClient::State::refused) {
    return {kDeviceDriveFault, {step.what, canopen::sdo_abort_words(sdo_.value()), sdo_.value()}};
  }
  if (state == SdoClient::State::too_long) {
    return {kDeviceDriveFault,
            {step.what,
             "the drive's answer is longer than 4 bytes, which this driver does not read: check "
             "the drive's type and firmware",
             step.object.index}};
  }
  return {kDeviceLost,
          {step.what, "the drive does not answer: check its power and cable, then reset",
           step.object.index}};
}

std::optional<std::uint32_t> DriveObjects::read(canopen::ObjectAddress object, hal::TimeNs now_ns,
                                                CanOutbox& outbox) {
  if (sdo_.state() == SdoClient::State::idle) {
    sdo_.read(object);
  }
  sdo_.run(now_ns, outbox);
  if (is_asking()) {
    return std::nullopt;
  }
  const bool is_done = sdo_.state() == SdoClient::State::done;
  sdo_.reset();
  return is_done ? std::optional(sdo_.value()) : std::nullopt;
}

}  // namespace tactus::drivers::cia402
