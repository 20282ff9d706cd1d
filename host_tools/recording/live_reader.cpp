#include "host_tools/recording/live_reader.h"

#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "firmware/linux/telemetry/live_socket.h"
#include "firmware/linux/telemetry/mcap_format.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// Each message follows its length, 4 bytes, little endian.
constexpr std::size_t kLengthBytes = 4;
// A larger length means that the other side is no telemetry socket: a message has a few hundred
// bytes.
constexpr std::size_t kLongestMessage = std::size_t{1} << 20U;

// Every kind of message has its own FlatBuffers identifier, so at most one decoder accepts the
// bytes.
std::optional<LiveMessage> decode(std::span<const std::byte> message) {
  if (auto tick = decode_tick(message)) {
    return *tick;
  }
  if (const auto event = decode_event(message)) {
    return *event;
  }
  if (const auto explanation = decode_explanation(message)) {
    return *explanation;
  }
  if (const auto places = decode_object_places(message)) {
    return *places;
  }
  if (auto info = decode_run_info(message)) {
    return *std::move(info);
  }
  return std::nullopt;
}

}  // namespace

LiveReader::LiveReader(const std::string& socket)
    : name_(socket), socket_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (socket.size() >= sizeof(address.sun_path)) {
    throw InputError(socket + ": too long for the name of a socket");
  }
  std::memcpy(address.sun_path, socket.data(), socket.size());
  // The interface of sockets takes every kind of address as this one.
  if (connect(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)) != 0) {
    const bool nobody = errno == ENOENT || errno == ECONNREFUSED;
    throw InputError(socket + ": " +
                     (nobody ? "nobody answers there: is tactusd running, and with this --run-dir?"
                             : std::strerror(errno)));
  }
}

// next() finds out that the other side has closed.
void LiveReader::ask_for_explanations(bool wanted) {
  const std::byte asked = wanted ? firmware::kWantExplanations : firmware::kWantNoExplanations;
  (void)send(socket_.get(), &asked, 1, MSG_NOSIGNAL | MSG_DONTWAIT);
}

void LiveReader::ask_for_places() {
  (void)send(socket_.get(), &firmware::kWantPlaces, 1, MSG_NOSIGNAL | MSG_DONTWAIT);
}

std::optional<LiveMessage> LiveReader::next(std::chrono::milliseconds patience) {
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (;;) {
    while (const auto message = take_message()) {
      if (auto decoded = decode(*message)) {
        return decoded;
      }
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(
        deadline - std::chrono::steady_clock::now());
    if (!receive(std::max(left, std::chrono::milliseconds(0)))) {
      return std::nullopt;
    }
  }
}

std::optional<std::span<const std::byte>> LiveReader::take_message() {
  firmware::mcap::Unpacker unpacker{std::span(buffer_).subspan(begin_)};
  const std::uint32_t length = unpacker.u32();
  if (!unpacker.failed() && length > kLongestMessage) {
    throw InputError(name_ + ": this is not the telemetry of tactusd");
  }
  const auto message = unpacker.bytes(length);
  if (unpacker.failed()) {
    return std::nullopt;
  }
  begin_ += kLengthBytes + message.size();
  return message;
}

bool LiveReader::receive(std::chrono::milliseconds patience) {
  pollfd readable{.fd = socket_.get(), .events = POLLIN, .revents = 0};
  if (ended_ || poll(&readable, 1, static_cast<int>(patience.count())) <= 0) {
    return false;
  }
  // Bytes that were given out are removed once a receive, not once a message.
  buffer_.erase(buffer_.begin(), buffer_.begin() + static_cast<std::ptrdiff_t>(begin_));
  begin_ = 0;
  std::array<std::byte, 65536> received;
  const ssize_t count = recv(socket_.get(), received.data(), received.size(), 0);
  if (count <= 0) {
    ended_ = true;
    return false;
  }
  buffer_.insert(buffer_.end(), received.begin(), received.begin() + count);
  return true;
}

}  // namespace tactus::host
