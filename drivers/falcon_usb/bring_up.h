// Brings a Falcon up from the plug to its first answer: the serial settings of its FTDI chip, a
// probe for firmware, and the upload in two stages if there is none. It is a state machine without
// input or output; the time comes in its arguments.
//
//   normal mode -> probe -+-> up
//                         +-> handshake at 9600 baud -> loader at 143 kbaud -> image in chunks,
//                             each sent back by the device and compared -> normal mode
//                             -> probe -> up
//
// The firmware is volatile: it is needed after each power cycle, but not after reopening. It
// belongs to the device's maker, and comes from a file that the user has.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "drivers/falcon_usb/packet.h"
#include "hal/clock.h"
#include "hal/usb_endpoint.h"

namespace tactus::drivers {

class FalconBringUp {
 public:
  enum class Outcome : std::uint8_t {
    under_way,
    up,
    refuses_settings,  // the chip does not accept its serial settings
    no_firmware,       // the device has none, and none was given
    no_loader,         // the device's loader does not answer
    load_failed,       // the device does not send the image back unchanged
    firmware_silent,   // the device took the image, but does not answer
  };

  // An action for the caller: nothing yet, a control request, or bytes to send by bulk-out.
  struct Action {
    enum class Kind : std::uint8_t { nothing, control, send } kind = Kind::nothing;
    hal::UsbSetup setup;
    std::span<const std::byte> bytes;  // at most kFalconChunkBytes; valid until the next call
  };

  // The firmware must outlive the object. An empty span: there is none to upload.
  explicit FalconBringUp(std::span<const std::byte> firmware) : firmware_(firmware) {}

  void start(hal::TimeNs now_ns);
  // Returns the next action. Call until it returns `nothing`. A returned action counts as done
  // unless `refused` is called.
  Action next(hal::TimeNs now_ns);
  // Reports that the last action failed.
  void refused(hal::TimeNs now_ns);
  // Takes payload bytes from the device.
  void take(std::span<const std::byte> payload, hal::TimeNs now_ns);

  [[nodiscard]] Outcome outcome() const { return outcome_; }
  // Returns the bytes of the image that the device has sent back in this attempt, for a progress
  // report.
  [[nodiscard]] std::size_t loaded_bytes() const { return upload_.loaded; }
  // Returns the number of the attempt at the upload, from 1; 0: none was needed.
  [[nodiscard]] std::uint32_t attempt() const { return upload_.attempt; }

 private:
  enum class Phase : std::uint8_t {
    normal_mode,
    probe,
    handshake_mode,
    handshake,
    loader_mode,
    loader,
    image,
  };

  // The phase and the progress in it. Each phase begins with a fresh one.
  struct Stage {
    Phase phase = Phase::normal_mode;
    // The index of the next one in settings().
    std::size_t step = 0;
    // The number of sends.
    std::uint32_t tries = 0;
    // The time until which an answer is waited for.
    hal::TimeNs answer_by_ns = 0;
    // The last bytes, in which the answer to the handshake is looked for.
    std::array<std::byte, 4> heard{};
    // The answers to the probe.
    FalconPacketReader reader;
  };

  // An upload of the image.
  struct Upload {
    // The number of the attempt; 0: none was needed.
    std::uint32_t attempt = 0;
    // The bytes of the image that were sent, and those of them that came back unchanged.
    std::size_t sent = 0;
    std::size_t loaded = 0;
  };

  void enter(Phase phase, hal::TimeNs now_ns);
  void end(Outcome outcome) { outcome_ = outcome; }
  void begin_attempt(hal::TimeNs now_ns);
  void settings_done(hal::TimeNs now_ns);
  [[nodiscard]] std::span<const hal::UsbSetup> settings() const;

  Action probe(hal::TimeNs now_ns);
  Action shake_hands(hal::TimeNs now_ns);
  Action call_loader(hal::TimeNs now_ns);
  Action send_image(hal::TimeNs now_ns);
  Action send(std::span<const std::byte> bytes, hal::TimeNs patience_ns, hal::TimeNs now_ns);

  void take_handshake(std::byte byte, hal::TimeNs now_ns);
  void take_echo(std::byte byte, hal::TimeNs now_ns);

  std::span<const std::byte> firmware_;
  Outcome outcome_ = Outcome::under_way;
  Stage stage_;
  Upload upload_;
  // The number of refusals of the serial settings.
  std::uint32_t refusals_ = 0;
  FalconPacket probe_packet_{};
};

inline constexpr std::size_t kFalconChunkBytes = 62;

}  // namespace tactus::drivers
