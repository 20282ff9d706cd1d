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
  [[nodiscard]] std::size_t loaded_bytes() const { return loaded_; }
  // Returns the number of the attempt at the upload, from 1; 0: none was needed.
  [[nodiscard]] std::uint32_t attempt() const { return attempt_; }

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
  Phase phase_ = Phase::normal_mode;
  Outcome outcome_ = Outcome::under_way;
  std::size_t step_ = 0;     // in settings()
  std::uint32_t tries_ = 0;  // sends in this phase
  std::uint32_t refusals_ = 0;
  std::uint32_t attempt_ = 0;  // at the upload
  hal::TimeNs answer_by_ns_ = 0;
  std::size_t sent_ = 0;    // bytes of the image
  std::size_t loaded_ = 0;  // of those, sent back unchanged
  std::array<std::byte, 4> heard_{};
  FalconPacketReader reader_;
  FalconPacket probe_packet_{};
};

inline constexpr std::size_t kFalconChunkBytes = 62;

}  // namespace tactus::drivers
