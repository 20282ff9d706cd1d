#include "drivers/falcon_usb/bring_up.h"

#include <algorithm>

namespace tactus::drivers {

namespace {

constexpr hal::TimeNs kMs = 1'000'000;
constexpr std::uint32_t kProbes = 100;
constexpr hal::TimeNs kProbePatience_ns = 10 * kMs;
constexpr std::uint32_t kHandshakes = 100;
constexpr hal::TimeNs kHandshakePatience_ns = 50 * kMs;
constexpr hal::TimeNs kLoaderPatience_ns = 200 * kMs;
constexpr hal::TimeNs kChunkPatience_ns = 500 * kMs;
constexpr std::uint32_t kAttempts = 10;
constexpr std::uint32_t kSettingsRefusals = 10;

// Control requests of the FTDI chip.
enum FtdiRequest : std::uint8_t {
  kFtdiReset = 0,
  kFtdiModemControl = 1,
  kFtdiFlowControl = 2,
  kFtdiBaud = 3,
  kFtdiData = 4,
  kFtdiLatency = 9,
};

constexpr hal::UsbSetup ftdi(FtdiRequest request, std::uint16_t value) {
  return {.request_type = 0x40, .request = request, .value = value, .index = 0};
}

constexpr hal::UsbSetup kPurgeInput = ftdi(kFtdiReset, 1);
constexpr hal::UsbSetup kPurgeOutput = ftdi(kFtdiReset, 2);
constexpr hal::UsbSetup kDtrLow = ftdi(kFtdiModemControl, 0x0100);
constexpr hal::UsbSetup kDtrHigh = ftdi(kFtdiModemControl, 0x0101);
constexpr hal::UsbSetup kRtsLow = ftdi(kFtdiModemControl, 0x0200);

constexpr std::array kNormalMode = {
    kPurgeInput, kPurgeOutput, ftdi(kFtdiLatency, 1), ftdi(kFtdiBaud, 0x0002),  // 1.5 Mbaud
    kPurgeInput, kPurgeOutput,
};
constexpr std::array kHandshakeMode = {
    kPurgeInput,
    kPurgeOutput,
    ftdi(kFtdiLatency, 16),
    ftdi(kFtdiBaud, 0x4138),  // 9600 baud
    ftdi(kFtdiData, 8),       // 8N1
    ftdi(kFtdiFlowControl, 0),
    kRtsLow,
    kDtrLow,
    kDtrHigh,
};
constexpr std::array kLoaderMode = {
    kDtrLow, ftdi(kFtdiBaud, 0x0015),  // 142,857 baud
};

constexpr std::array kHandshakeCall = {std::byte{0x0A}, std::byte{0x43}, std::byte{0x0D}};
constexpr std::array kHandshakeAnswer = {std::byte{0x0A}, std::byte{0x44}, std::byte{0x2C},
                                         std::byte{0x0D}};
constexpr std::array kLoaderCall = {std::byte{0x41}};

}  // namespace

void FalconBringUp::start(hal::TimeNs now_ns) {
  outcome_ = Outcome::under_way;
  attempt_ = 0;
  refusals_ = 0;
  loaded_ = 0;
  enter(Phase::normal_mode, now_ns);
}

void FalconBringUp::enter(Phase phase, hal::TimeNs now_ns) {
  phase_ = phase;
  step_ = 0;
  tries_ = 0;
  answer_by_ns_ = now_ns;
  heard_ = {};
  reader_.restart();
}

void FalconBringUp::begin_attempt(hal::TimeNs now_ns) {
  if (attempt_ == kAttempts) {
    end(Outcome::load_failed);
    return;
  }
  ++attempt_;
  sent_ = 0;
  loaded_ = 0;
  enter(Phase::handshake_mode, now_ns);
}

std::span<const hal::UsbSetup> FalconBringUp::settings() const {
  switch (phase_) {
    case Phase::normal_mode:
      return kNormalMode;
    case Phase::handshake_mode:
      return kHandshakeMode;
    case Phase::loader_mode:
      return kLoaderMode;
    default:
      return {};
  }
}

void FalconBringUp::settings_done(hal::TimeNs now_ns) {
  if (phase_ == Phase::normal_mode) {
    enter(Phase::probe, now_ns);
  } else if (phase_ == Phase::handshake_mode) {
    enter(Phase::handshake, now_ns);
  } else {
    enter(Phase::loader, now_ns);
  }
}

FalconBringUp::Action FalconBringUp::next(hal::TimeNs now_ns) {
  if (outcome_ != Outcome::under_way) {
    return {};
  }
  if (const auto left = settings().subspan(std::min(step_, settings().size())); !left.empty()) {
    ++step_;
    return {.kind = Action::Kind::control, .setup = left.front(), .bytes = {}};
  }
  if (!settings().empty()) {
    settings_done(now_ns);
  }
  if (now_ns < answer_by_ns_) {
    return {};
  }
  switch (phase_) {
    case Phase::probe:
      return probe(now_ns);
    case Phase::handshake:
      return shake_hands(now_ns);
    case Phase::loader:
      return call_loader(now_ns);
    default:
      return send_image(now_ns);
  }
}

FalconBringUp::Action FalconBringUp::send(std::span<const std::byte> bytes, hal::TimeNs patience_ns,
                                          hal::TimeNs now_ns) {
  ++tries_;
  answer_by_ns_ = now_ns + patience_ns;
  return {.kind = Action::Kind::send, .setup = {}, .bytes = bytes};
}

FalconBringUp::Action FalconBringUp::probe(hal::TimeNs now_ns) {
  if (tries_ < kProbes) {
    probe_packet_ = encode(FalconCommand{.motor = {}, .lights = {.red = true}});
    return send(probe_packet_, kProbePatience_ns, now_ns);
  }
  if (attempt_ > 0) {
    end(Outcome::firmware_silent);
  } else if (firmware_.empty()) {
    end(Outcome::no_firmware);
  } else {
    begin_attempt(now_ns);
  }
  return {};
}

FalconBringUp::Action FalconBringUp::shake_hands(hal::TimeNs now_ns) {
  if (tries_ == kHandshakes) {
    end(Outcome::no_loader);
    return {};
  }
  return send(kHandshakeCall, kHandshakePatience_ns, now_ns);
}

FalconBringUp::Action FalconBringUp::call_loader(hal::TimeNs now_ns) {
  if (tries_ > 0) {  // the loader was called once and did not answer
    begin_attempt(now_ns);
    return {};
  }
  return send(kLoaderCall, kLoaderPatience_ns, now_ns);
}

FalconBringUp::Action FalconBringUp::send_image(hal::TimeNs now_ns) {
  if (loaded_ < sent_) {
    begin_attempt(now_ns);
    return {};
  }
  const auto chunk =
      firmware_.subspan(sent_, std::min(kFalconChunkBytes, firmware_.size() - sent_));
  sent_ += chunk.size();
  return send(chunk, kChunkPatience_ns, now_ns);
}

void FalconBringUp::refused(hal::TimeNs now_ns) {
  if (outcome_ != Outcome::under_way || phase_ == Phase::probe || phase_ == Phase::handshake) {
    return;  // refusals here are tried again anyway
  }
  if (phase_ == Phase::normal_mode) {
    ++refusals_;
    step_ = 0;
    if (refusals_ == kSettingsRefusals) {
      end(Outcome::refuses_settings);
    }
    return;
  }
  begin_attempt(now_ns);
}

void FalconBringUp::take(std::span<const std::byte> payload, hal::TimeNs now_ns) {
  for (const std::byte byte : payload) {
    if (outcome_ != Outcome::under_way) {
      return;
    }
    if (phase_ == Phase::probe) {
      if (reader_.take(byte)) {
        end(Outcome::up);
      }
    } else if (phase_ == Phase::handshake) {
      take_handshake(byte, now_ns);
    } else if (phase_ == Phase::loader && tries_ > 0 && byte == kLoaderCall.front()) {
      enter(Phase::image, now_ns);  // anything else is a late answer to the handshake
    } else if (phase_ == Phase::image) {
      take_echo(byte, now_ns);
    }
  }
}

void FalconBringUp::take_handshake(std::byte byte, hal::TimeNs now_ns) {
  std::ranges::rotate(heard_, heard_.begin() + 1);
  heard_.back() = byte;
  if (heard_ == kHandshakeAnswer) {
    enter(Phase::loader_mode, now_ns);
  }
}

void FalconBringUp::take_echo(std::byte byte, hal::TimeNs now_ns) {
  if (loaded_ == sent_ || firmware_[loaded_] != byte) {
    begin_attempt(now_ns);
    return;
  }
  ++loaded_;
  if (loaded_ == firmware_.size()) {
    enter(Phase::normal_mode, now_ns);
  } else if (loaded_ == sent_) {
    answer_by_ns_ = now_ns;
  }
}

}  // namespace tactus::drivers
