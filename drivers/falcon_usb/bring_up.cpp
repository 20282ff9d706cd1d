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
  refusals_ = 0;
  upload_ = {};
  enter(Phase::normal_mode, now_ns);
}

void FalconBringUp::enter(Phase phase, hal::TimeNs now_ns) {
  stage_ = {.phase = phase, .answer_by_ns = now_ns};
}

void FalconBringUp::begin_attempt(hal::TimeNs now_ns) {
  if (upload_.attempt == kAttempts) {
    end(Outcome::load_failed);
    return;
  }
  upload_ = {.attempt = upload_.attempt + 1};
  enter(Phase::handshake_mode, now_ns);
}

std::span<const hal::UsbSetup> FalconBringUp::settings() const {
  switch (stage_.phase) {
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
  if (stage_.phase == Phase::normal_mode) {
    enter(Phase::probe, now_ns);
  } else if (stage_.phase == Phase::handshake_mode) {
    enter(Phase::handshake, now_ns);
  } else {
    enter(Phase::loader, now_ns);
  }
}

FalconBringUp::Action FalconBringUp::next(hal::TimeNs now_ns) {
  if (outcome_ != Outcome::under_way) {
    return {};
  }
  if (const auto left = settings().subspan(std::min(stage_.step, settings().size()));
      !left.empty()) {
    ++stage_.step;
    return {.kind = Action::Kind::control, .setup = left.front(), .bytes = {}};
  }
  if (!settings().empty()) {
    settings_done(now_ns);
  }
  if (now_ns < stage_.answer_by_ns) {
    return {};
  }
  switch (stage_.phase) {
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
  ++stage_.tries;
  stage_.answer_by_ns = now_ns + patience_ns;
  return {.kind = Action::Kind::send, .setup = {}, .bytes = bytes};
}

FalconBringUp::Action FalconBringUp::probe(hal::TimeNs now_ns) {
  if (stage_.tries < kProbes) {
    probe_packet_ = encode(FalconCommand{.motor = {}, .lights = {.red = true}});
    return send(probe_packet_, kProbePatience_ns, now_ns);
  }
  if (upload_.attempt > 0) {
    end(Outcome::firmware_silent);
  } else if (firmware_.empty()) {
    end(Outcome::no_firmware);
  } else {
    begin_attempt(now_ns);
  }
  return {};
}

FalconBringUp::Action FalconBringUp::shake_hands(hal::TimeNs now_ns) {
  if (stage_.tries == kHandshakes) {
    end(Outcome::no_loader);
    return {};
  }
  return send(kHandshakeCall, kHandshakePatience_ns, now_ns);
}

FalconBringUp::Action FalconBringUp::call_loader(hal::TimeNs now_ns) {
  if (stage_.tries > 0) {  // the loader was called once and did not answer
    begin_attempt(now_ns);
    return {};
  }
  return send(kLoaderCall, kLoaderPatience_ns, now_ns);
}

FalconBringUp::Action FalconBringUp::send_image(hal::TimeNs now_ns) {
  if (upload_.loaded < upload_.sent) {
    begin_attempt(now_ns);
    return {};
  }
  const auto chunk =
      firmware_.subspan(upload_.sent, std::min(kFalconChunkBytes, firmware_.size() - upload_.sent));
  upload_.sent += chunk.size();
  return send(chunk, kChunkPatience_ns, now_ns);
}

void FalconBringUp::refused(hal::TimeNs now_ns) {
  if (outcome_ != Outcome::under_way || stage_.phase == Phase::probe ||
      stage_.phase == Phase::handshake) {
    return;  // refusals here are tried again anyway
  }
  if (stage_.phase == Phase::normal_mode) {
    ++refusals_;
    stage_.step = 0;
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
    if (stage_.phase == Phase::probe) {
      if (stage_.reader.take(byte)) {
        end(Outcome::up);
      }
    } else if (stage_.phase == Phase::handshake) {
      take_handshake(byte, now_ns);
    } else if (stage_.phase == Phase::loader && stage_.tries > 0 && byte == kLoaderCall.front()) {
      enter(Phase::image, now_ns);  // anything else is a late answer to the handshake
    } else if (stage_.phase == Phase::image) {
      take_echo(byte, now_ns);
    }
  }
}

void FalconBringUp::take_handshake(std::byte byte, hal::TimeNs now_ns) {
  std::ranges::rotate(stage_.heard, stage_.heard.begin() + 1);
  stage_.heard.back() = byte;
  if (stage_.heard == kHandshakeAnswer) {
    enter(Phase::loader_mode, now_ns);
  }
}

void FalconBringUp::take_echo(std::byte byte, hal::TimeNs now_ns) {
  if (upload_.loaded == upload_.sent || firmware_[upload_.loaded] != byte) {
    begin_attempt(now_ns);
    return;
  }
  ++upload_.loaded;
  if (upload_.loaded == firmware_.size()) {
    enter(Phase::normal_mode, now_ns);
  } else if (upload_.loaded == upload_.sent) {
    stage_.answer_by_ns = now_ns;
  }
}

}  // namespace tactus::drivers
