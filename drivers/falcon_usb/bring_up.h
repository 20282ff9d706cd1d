// From a Falcon just plugged in to one that answers: the serial settings of its FTDI chip, a probe
// for firmware, and the upload in two stages where there is none. A state machine without input or
// output, with the time in its arguments.
//
//   normal mode -> probe -+-> up
//                         +-> handshake at 9600 baud -> loader at 143 kbaud -> image in chunks,
//                         each
//                             sent back by the device and compared -> normal mode -> probe -> up
//
// The firmware is volatile (needed after each power cycle, not after reopening) and belongs to the
// device's maker: it comes from a file that the user has.
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
    refuses_settings,  // the chip does not take its serial settings
    no_firmware,       // the device has none and we were given none
    no_loader,         // its loader does not answer
    load_failed,       // it does not send the image back as it was sent
    firmware_silent,   // the image was taken, and what it is does not answer
  };

  // What the caller is to do: nothing yet, a control request, or bytes by bulk-out.
  struct Action {
    enum class Kind : std::uint8_t { nothing, control, send } kind = Kind::nothing;
    hal::UsbSetup setup;
    std::span<const std::byte> bytes;  // at most kFalconChunkBytes; valid until the next call
  };

  // The firmware must outlive the object; empty: there is none to upload.
  explicit FalconBringUp(std::span<const std::byte> firmware) : firmware_(firmware) {}

  void start(hal::TimeNs now_ns);
  // Call until it says nothing. What is handed out counts as done; `refused` takes it back.
  Action next(hal::TimeNs now_ns);
  // The last action did not succeed.
  void refused(hal::TimeNs now_ns);
  // Payload from the device.
  void take(std::span<const std::byte> payload, hal::TimeNs now_ns);

  [[nodiscard]] Outcome outcome() const { return outcome_; }
  // Bytes of the image that the device has sent back in this attempt, for a progress report.
  [[nodiscard]] std::size_t loaded_bytes() const { return loaded_; }
  // Which attempt at the whole upload this is, from 1; 0: none was needed.
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
  std::uint32_t tries_ = 0;  // in this phase
  std::uint32_t refusals_ = 0;
  std::uint32_t attempt_ = 0;  // at the upload
  hal::TimeNs answer_by_ns_ = 0;
  std::size_t sent_ = 0;    // bytes of the image
  std::size_t loaded_ = 0;  // of those, sent back as they were
  std::array<std::byte, 4> heard_{};
  FalconPacketReader reader_;
  FalconPacket probe_packet_{};
};

inline constexpr std::size_t kFalconChunkBytes = 62;

}  // namespace tactus::drivers
