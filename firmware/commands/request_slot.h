// Holds the operator's newest request for the tick. A newer request replaces one that no tick has
// taken yet; only another estop replaces an estop.
//
// One thread posts, the loop's thread takes. Lock-free: `take` is one atomic exchange, and real
// time.
#pragma once

#include <atomic>
#include <cstdint>

#include "firmware/control/mode.h"

namespace tactus::firmware {

// The number of a command; its answer carries the same number. 0 means that nobody waits.
using Ticket = std::uint32_t;
// The largest ticket: a request and its ticket are one word of the smallest processor.
inline constexpr Ticket kLargestTicket = 0xFF'FFFF;

// A request with the number of its command.
struct TicketedRequest {
  Request request = Request::none;
  Ticket ticket = 0;
};

// The slot. Request and ticket are one 32-bit word, so that a tick never takes half of each.
class RequestSlot {
 public:
  // The result of post().
  struct Posted {
    // False: an estop waits for its tick, and the request is refused.
    bool accepted = false;
    // The request that no tick will see; Request::none if there was none.
    TicketedRequest replaced;
  };

  // Puts a request into the slot. Its ticket is at most kLargestTicket.
  Posted post(const TicketedRequest& newer);

  // Returns the newest request since the last call, or Request::none.
  TicketedRequest take() { return unpack(word_.exchange(kEmpty, std::memory_order_acquire)); }

 private:
  static constexpr std::uint32_t kEmpty = 0;
  static constexpr unsigned kTicketShift = 8;

  static constexpr std::uint32_t pack(const TicketedRequest& request) {
    return request.ticket << kTicketShift | static_cast<std::uint32_t>(request.request);
  }
  static constexpr TicketedRequest unpack(std::uint32_t word) {
    return {.request = static_cast<Request>(word & 0xffU), .ticket = word >> kTicketShift};
  }

  std::atomic<std::uint32_t> word_{kEmpty};
  static_assert(std::atomic<std::uint32_t>::is_always_lock_free);
};

}  // namespace tactus::firmware
