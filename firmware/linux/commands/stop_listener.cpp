#include "firmware/linux/commands/stop_listener.h"

#include <poll.h>
#include <sched.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <cstddef>
#include <ctime>
#include <string_view>

#include "firmware/linux/commands/reply.h"

namespace tactus::firmware {
namespace {

// The thread looks at this interval whether it is to end.
constexpr hal::TimeNs kLookForStopsEnd_ns = 100'000'000;
// The thread looks for the tick that took the stop at this interval, this many times: 50 ms in all,
// a tick at the slowest rate taking 20 ms.
constexpr timespec kLookForTick{.tv_sec = 0, .tv_nsec = 200'000};
constexpr int kMostLooksForTick = 250;
// The largest number of senders that one tick answers. Further ones wait for the next tick.
constexpr std::size_t kMostSenders = 32;

// The address of a sender; its size is small if it has none.
struct Sender {
  sockaddr_un address{};
  socklen_t size = 0;
};

// Returns the address as the general type that the socket calls take.
sockaddr* as_plain(sockaddr_un& address) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  return reinterpret_cast<sockaddr*>(&address);
}

// Takes one datagram, whatever it contains. Returns false if there is none.
bool receive(int socket, Sender& sender) {
  std::array<char, 64> any{};
  sender.size = sizeof sender.address;
  return ::recvfrom(socket, any.data(), any.size(), MSG_DONTWAIT | MSG_TRUNC,
                    as_plain(sender.address), &sender.size) >= 0;
}

void write_stop_reply(TextLine& line, const std::optional<StopTaken>& taken) {
  if (!taken) {
    write_refusal(line, "estop", "the loop has not answered; cut the power");
    return;
  }
  line.add("ok estop tick=").add(taken->tick).add(" mode=").add(mode_name(taken->after)).end();
}

}  // namespace

std::expected<void, ListenError> StopListener::start(const StopListenerConfig& config) {
  priority_ = config.priority;
  if (auto open = socket_.open_datagrams(config.socket_path, config.group); !open) {
    return open;
  }
  const int error = thread_.start(
      "tactus-stop", [](void* self) { static_cast<StopListener*>(self)->run(); }, this);
  if (error != 0) {
    socket_.close();
    return std::unexpected(ListenError{.what = "the system gives no thread", .errno_value = error});
  }
  return {};
}

void StopListener::stop() {
  is_ending_.store(true, std::memory_order_relaxed);
  thread_.join();
  is_ending_.store(false, std::memory_order_relaxed);
  socket_.close();
}

void StopListener::run() {
  if (priority_ > 0) {
    const sched_param wanted{.sched_priority = priority_};
    // If the right is missing, the loop lacks it too and the program has already printed that.
    (void)sched_setscheduler(0, SCHED_FIFO, &wanted);
  }
  while (!is_ending_.load(std::memory_order_relaxed)) {
    if (hal::wait_readable(socket_.descriptor(), hal::monotonic_now_ns() + kLookForStopsEnd_ns)) {
      hear_all();
    }
  }
}

void StopListener::hear_all() {
  std::array<Sender, kMostSenders> senders;
  std::size_t heard = 0;
  std::uint32_t stop = 0;
  while (heard < senders.size() && receive(socket_.descriptor(), senders[heard])) {
    stop = queue_.post_stop();
    ++heard;
  }
  if (heard == 0) {
    return;
  }
  std::optional<StopTaken> taken = queue_.stop_taken(stop);
  for (int look = 0; look < kMostLooksForTick && !taken; ++look) {
    ::nanosleep(&kLookForTick, nullptr);
    taken = queue_.stop_taken(stop);
  }
  TextLine line;
  write_stop_reply(line, taken);
  for (std::size_t i = 0; i < heard; ++i) {
    if (senders[i].size > offsetof(sockaddr_un, sun_path)) {
      (void)::sendto(socket_.descriptor(), line.text().data(), line.text().size(),
                     MSG_DONTWAIT | MSG_NOSIGNAL, as_plain(senders[i].address), senders[i].size);
    }
  }
}

}  // namespace tactus::firmware
