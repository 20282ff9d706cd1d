#include "firmware/linux/commands/command_client.h"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

namespace tactus::firmware {

void CommandClient::connect(hal::FileDescriptor socket) {
  disconnect();
  socket_ = std::move(socket);
}

void CommandClient::disconnect() {
  socket_.reset();
  size_ = 0;
  has_ended_ = false;
  is_skipping_ = false;
  was_overlong_ = false;
  out_.clear();
  sent_ = 0;
  stuck_since_ns_ = 0;
  waiting = {};
}

bool CommandClient::is_done() const {
  return has_ended_ && !line() && !was_overlong_ && !waiting.is_under_way && out_.empty();
}

bool CommandClient::receive() {
  const ssize_t got = ::recv(socket_.get(), in_.data() + size_, in_.size() - size_, MSG_DONTWAIT);
  if (got < 0) {
    return errno == EAGAIN || errno == EINTR;
  }
  has_ended_ = got == 0;
  size_ += static_cast<std::size_t>(got);
  // The rest of an overlong line ends at its newline; the bytes after it are the next line.
  if (is_skipping_) {
    const auto end = received().find('\n');
    is_skipping_ = end == std::string_view::npos;
    drop_line();
  }
  if (size_ == in_.size() && !line()) {
    is_skipping_ = true;
    was_overlong_ = true;
    size_ = 0;
  }
  return true;
}

std::optional<std::string_view> CommandClient::line() const {
  const std::size_t end = received().find('\n');
  if (end == std::string_view::npos) {
    return std::nullopt;
  }
  return received().substr(0, end);
}

void CommandClient::drop_line() {
  const std::size_t end = received().find('\n');
  const std::size_t taken = end == std::string_view::npos ? size_ : end + 1;
  std::memmove(in_.data(), in_.data() + taken, size_ - taken);
  size_ -= taken;
}

bool CommandClient::take_overlong() {
  return std::exchange(was_overlong_, false);
}

bool CommandClient::send(hal::TimeNs now_ns) {
  const std::string_view rest = out_.text().substr(sent_);
  const ssize_t sent = ::send(socket_.get(), rest.data(), rest.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent < 0) {
    stuck_since_ns_ = stuck_since_ns_ == 0 ? now_ns : stuck_since_ns_;
    return (errno == EAGAIN || errno == EINTR) && now_ns - stuck_since_ns_ < kPatience_ns;
  }
  stuck_since_ns_ = 0;
  sent_ += static_cast<std::size_t>(sent);
  if (sent_ == out_.text().size()) {
    out_.clear();
    sent_ = 0;
  }
  return true;
}

std::string_view word_of(const CommandClient::Waiting& waiting) {
  switch (waiting.verb) {
    case Verb::request:
      return kRequestNames[static_cast<std::size_t>(waiting.command.request)];
    case Verb::set:
      return "set";
    case Verb::get:
      return "get";
    case Verb::list:
      return "list";
    case Verb::status:
      return "status";
    case Verb::scene:
      return "scene";
    case Verb::record:
      return "record";
    case Verb::inject:
      return "inject";
    case Verb::help:
      return "help";
  }
  return {};
}

}  // namespace tactus::firmware
