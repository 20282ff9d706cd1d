// The messages between a board and a host on a serial line. README.md has the table. A message is
// one byte, its MessageType, and then its fields in the order of message_fields.h, each least
// significant byte first. Any thread; no heap; real time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/line/frame.h"
#include "firmware/telemetry/recorded_tick.h"

namespace tactus::firmware {

// The version of the messages. A board and a host of different versions refuse each other.
inline constexpr std::uint8_t kLineVersion = 1;

// The kinds of messages. The numbers are stable; each satisfies begins_message.
enum class MessageType : std::uint8_t {
  // The board sends these.
  hello = 1,
  tick = 2,
  answer = 3,
  image_part = 4,
  // The host sends these.
  ask_hello = 16,
  ask_ticks = 17,
  ask_image = 18,
  command = 19,
  stop = 20,
  alive = 21,
  release = 22,
};

// A name of at most 24 characters, zeros behind it.
using LineName = std::array<char, 24>;
// Returns the name for a message; the rest of a longer one is left out.
LineName line_name(std::string_view name);
// Returns the name as a text, without the zeros behind it.
std::string_view text_of(const LineName& name);

// An image of the board: the checksum in its header, and its size.
struct ImageOnBoard {
  std::uint64_t checksum = 0;
  std::uint32_t bytes = 0;
};

// The board tells what it is: the answer to AskHello.
struct Hello {
  std::uint8_t version = kLineVersion;
  LineName board{};
  LineName profile{};
  double rate_hz = 0.0;
  std::uint8_t joints = 0;
  ImageOnBoard device;
  ImageOnBoard scene;
  // The number of the next tick.
  std::uint64_t next_tick = 0;
  // The commands that may wait for their answers at a time; the board leaves out more.
  std::uint16_t most_waiting = 0;
  // The bytes that wait for the line at most. A frame that finds no room is left out.
  std::uint16_t room_bytes = 0;
  // The frames of the host that the board found broken, and the bytes that came too fast for it,
  // since its start.
  std::uint32_t broken_frames = 0;
  std::uint32_t lost_bytes = 0;
};

// An image that the host may ask for.
enum class BoardImage : std::uint8_t { device, scene };

// The largest number of bytes of an image in one message.
inline constexpr std::size_t kImagePartBytes = 512;

// Bytes of an image, which begin at `offset`. The view is of the message's bytes.
struct ImagePart {
  BoardImage image = BoardImage::device;
  std::uint32_t offset = 0;
  std::span<const std::byte> bytes;
};

// The host asks for a hello.
struct AskHello {};

// The host asks for each tick whose number is a multiple of `every`; for none if that is 0, as at
// the start.
struct AskTicks {
  std::uint32_t every = 0;
};

// The host asks for bytes of an image. The board sends them as several ImageParts in their order,
// cut at the image's end. A newer AskImage takes the place of this one.
struct AskImage {
  BoardImage image = BoardImage::device;
  std::uint32_t offset = 0;
  std::uint32_t bytes = 0;
};

// The operator's stop, which goes before everything else that waits. The board answers with an
// Answer of kind `request`, request `estop` and this ticket. Stops that come within one tick have
// one answer, with the ticket of the last.
struct LineStop {
  Ticket ticket = 0;
};

// The host supervises the board. From the first Alive on, a board that hears no message for
// kLineTimeout_s takes the line as lost: the fault kFaultLineLost. A tick with the fault
// is the last one that is sent, images are sent no more, and the supervision begins again
// with the next Alive.
struct Alive {};
inline constexpr double kLineTimeout_s = 0.5;

// The host ends its supervision, and asks for no more ticks and images.
struct Release {};

// Returns the type of a message, or nothing if its first byte is none.
std::optional<MessageType> type_of(std::span<const std::byte> message);

// Returns the version of a hello, whatever else it has; nothing if the message is no hello.
std::optional<std::uint8_t> hello_version(std::span<const std::byte> message);

// Writes a message, and returns its bytes within `room`, which has kMaxMessage bytes or more. A
// tick, a command and an answer have the fields that README.md names. An image part has
// kImagePartBytes at most.
std::span<const std::byte> write_message(const Hello& hello, std::span<std::byte> room);
std::span<const std::byte> write_message(const RecordedTick& tick, std::span<std::byte> room);
std::span<const std::byte> write_message(const Answer& answer, std::span<std::byte> room);
std::span<const std::byte> write_message(const ImagePart& part, std::span<std::byte> room);
std::span<const std::byte> write_message(const AskHello& ask, std::span<std::byte> room);
std::span<const std::byte> write_message(const AskTicks& ask, std::span<std::byte> room);
std::span<const std::byte> write_message(const AskImage& ask, std::span<std::byte> room);
std::span<const std::byte> write_message(const Command& command, std::span<std::byte> room);
std::span<const std::byte> write_message(const LineStop& stop, std::span<std::byte> room);
std::span<const std::byte> write_message(const Alive& alive, std::span<std::byte> room);
std::span<const std::byte> write_message(const Release& release, std::span<std::byte> room);

// Reads a message. Returns false if it is of another type or size, or if a number is out of its
// range: an enumeration's that has no such value, more joints than a device has, a name with
// control characters. Then the result has unspecified contents that are safe to read.
bool read_message(std::span<const std::byte> message, Hello& hello);
bool read_message(std::span<const std::byte> message, RecordedTick& tick);
bool read_message(std::span<const std::byte> message, Answer& answer);
bool read_message(std::span<const std::byte> message, ImagePart& part);
bool read_message(std::span<const std::byte> message, AskHello& ask);
bool read_message(std::span<const std::byte> message, AskTicks& ask);
bool read_message(std::span<const std::byte> message, AskImage& ask);
bool read_message(std::span<const std::byte> message, Command& command);
bool read_message(std::span<const std::byte> message, LineStop& stop);
bool read_message(std::span<const std::byte> message, Alive& alive);
bool read_message(std::span<const std::byte> message, Release& release);

}  // namespace tactus::firmware
