// Hands the newest request of an operator to the tick: a newer one takes the place of one that no
// tick has taken yet, except that nothing but another estop takes the place of an estop.
//
// One thread posts, the loop takes. Lock-free; `take` is one exchange and never waits.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/control/mode.h"

namespace tactus::firmware {

// Numbers the commands, so that an answer finds the one who waits for it. 0 is nobody.
using Ticket = std::uint32_t;

struct TicketedRequest {
  Request request = Request::none;
  Ticket ticket = 0;
};

class RequestSlot {
 public:
  struct Posted {
    bool accepted = false;     // false: an estop waits for its tick
    TicketedRequest replaced;  // what no tick will see; none if there was none
  };

  Posted post(const TicketedRequest& newer) {
    std::uint64_t waiting = word_.load(std::memory_order_relaxed);
    do {
      if (unpack(waiting).request == Request::estop && newer.request != Request::estop) {
        return {};
      }
    } while (!word_.compare_exchange_weak(waiting, pack(newer), std::memory_order_release,
                                          std::memory_order_relaxed));
    return {.accepted = true, .replaced = unpack(waiting)};
  }

  // The newest since the last call, or none.
  TicketedRequest take() { return unpack(word_.exchange(kEmpty, std::memory_order_acquire)); }

 private:
  static constexpr std::uint64_t kEmpty = 0;
  static constexpr unsigned kTicketShift = 8;

  static constexpr std::uint64_t pack(const TicketedRequest& request) {
    return static_cast<std::uint64_t>(request.ticket) << kTicketShift |
           static_cast<std::uint64_t>(request.request);
  }
  static constexpr TicketedRequest unpack(std::uint64_t word) {
    return {.request = static_cast<Request>(word & 0xffU),
            .ticket = static_cast<Ticket>(word >> kTicketShift)};
  }

  std::atomic<std::uint64_t> word_{kEmpty};
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace tactus::firmware
