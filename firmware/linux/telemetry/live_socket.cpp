#include "firmware/linux/telemetry/live_socket.h"

#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "firmware/linux/telemetry/mcap_format.h"

namespace tactus::firmware {
namespace {

// The size of the length before each message.
constexpr std::size_t kLengthBytes = 4;

hal::FileDescriptor stream_socket() {
  return hal::FileDescriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
}

// Returns the address as the general type that the socket calls take.
const sockaddr* generic(const sockaddr_un& address) {
  return reinterpret_cast<const sockaddr*>(&address);
}

// Returns true if a program listens there. EAGAIN means that it does, with a full queue.
bool has_listener(const sockaddr_un& address) {
  const hal::FileDescriptor probe = stream_socket();
  return connect(probe.get(), generic(address), sizeof(address)) == 0 || errno == EAGAIN;
}

}  // namespace

int LiveSocket::open(const char* path) {
  constexpr int kWaiting = 8;
  constexpr mode_t kOwnerAndGroup = 0660;
  const std::size_t length = std::strlen(path);
  address_ = {};
  address_.sun_family = AF_UNIX;
  if (length >= sizeof(address_.sun_path)) {
    return ENAMETOOLONG;
  }
  std::memcpy(address_.sun_path, path, length);
  hal::FileDescriptor listening = stream_socket();
  if (!listening.is_open()) {
    return errno;
  }
  int failed = bind(listening.get(), generic(address_), sizeof(address_));
  if (failed != 0 && errno == EADDRINUSE) {
    if (has_listener(address_)) {
      return EADDRINUSE;
    }
    unlink(address_.sun_path);
    failed = bind(listening.get(), generic(address_), sizeof(address_));
  }
  if (failed != 0 || chmod(address_.sun_path, kOwnerAndGroup) != 0 ||
      listen(listening.get(), kWaiting) != 0) {
    return errno;
  }
  listening_ = std::move(listening);
  return 0;
}

void LiveSocket::close() {
  if (!is_open()) {
    return;
  }
  for (Reader& reader : readers_) {
    reader.socket.reset();
  }
  listening_.reset();
  unlink(address_.sun_path);
  counts_.readers = 0;
}

void LiveSocket::accept_readers(std::span<const std::byte> greeting, hal::TimeNs now_ns) {
  while (is_open()) {
    hal::FileDescriptor socket(
        accept4(listening_.get(), nullptr, nullptr, SOCK_NONBLOCK | SOCK_CLOEXEC));
    if (!socket.is_open()) {
      return;
    }
    const auto place = std::ranges::find_if(
        readers_, [](const Reader& reader) { return !reader.socket.is_open(); });
    if (place == readers_.end()) {
      ++counts_.refused;
      continue;
    }
    place->socket = std::move(socket);
    place->begin = 0;
    place->end = 0;
    place->moved_ns = now_ns;
    place->wishes = {};
    ++counts_.readers;
    ++counts_.accepted;
    append(*place, greeting);
  }
}

LiveWishes LiveSocket::hear_readers() {
  LiveWishes wanted;
  for (Reader& reader : readers_) {
    if (!reader.socket.is_open()) {
      continue;
    }
    std::array<std::byte, 64> asked{};
    const ssize_t count = recv(reader.socket.get(), asked.data(), asked.size(), MSG_DONTWAIT);
    const auto bytes =
        std::span(asked).first(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    for (const std::byte byte : bytes) {
      if (byte == kWantExplanations || byte == kWantNoExplanations) {
        reader.wishes.explanations = byte == kWantExplanations;
      }
      reader.wishes.places = reader.wishes.places || byte == kWantPlaces;
    }
    wanted.explanations = wanted.explanations || reader.wishes.explanations;
    wanted.places = wanted.places || reader.wishes.places;
  }
  return wanted;
}

void LiveSocket::publish_explanation(std::span<const std::byte> message) {
  for (Reader& reader : readers_) {
    if (reader.socket.is_open() && reader.wishes.explanations) {
      append(reader, message);
    }
  }
}

void LiveSocket::publish_places(std::span<const std::byte> message) {
  for (Reader& reader : readers_) {
    if (reader.socket.is_open() && reader.wishes.places) {
      append(reader, message);
    }
  }
}

void LiveSocket::publish(std::span<const std::byte> message) {
  for (Reader& reader : readers_) {
    if (reader.socket.is_open()) {
      append(reader, message);
    }
  }
}

void LiveSocket::append(Reader& reader, std::span<const std::byte> message) {
  if (kLengthBytes + message.size() > kBufferBytes - reader.end) {
    // The rest moves to the front only when the end of the buffer is reached.
    std::memmove(reader.buffer.data(), reader.buffer.data() + reader.begin,
                 reader.end - reader.begin);
    reader.end -= reader.begin;
    reader.begin = 0;
  }
  if (kLengthBytes + message.size() > kBufferBytes - reader.end) {
    ++counts_.skipped;
    return;
  }
  mcap::Packer packer{std::span(reader.buffer).subspan(reader.end)};
  packer.u32(static_cast<std::uint32_t>(message.size())).bytes(message);
  reader.end += packer.size();
}

void LiveSocket::send(hal::TimeNs now_ns) {
  for (Reader& reader : readers_) {
    if (reader.socket.is_open()) {
      send_to(reader, now_ns);
    }
  }
}

void LiveSocket::send_to(Reader& reader, hal::TimeNs now_ns) {
  while (reader.begin < reader.end) {
    const ssize_t count = ::send(reader.socket.get(), reader.buffer.data() + reader.begin,
                                 reader.end - reader.begin, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count > 0) {
      reader.begin += static_cast<std::size_t>(count);
      reader.moved_ns = now_ns;
    } else if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
      if (now_ns - reader.moved_ns > kPatience_ns) {
        let_go(reader);
      }
      return;
    } else {
      let_go(reader);
      return;
    }
  }
  reader.moved_ns = now_ns;
}

void LiveSocket::let_go(Reader& reader) {
  reader.socket.reset();
  --counts_.readers;
  ++counts_.lost;
}

}  // namespace tactus::firmware
