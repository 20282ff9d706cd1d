#include "firmware/commands/request_slot.h"

namespace tactus::firmware {

RequestSlot::Posted RequestSlot::post(const TicketedRequest& newer) {
  std::uint32_t waiting = word_.load(std::memory_order_relaxed);
  do {
    if (unpack(waiting).request == Request::estop && newer.request != Request::estop) {
      return {};
    }
  } while (!word_.compare_exchange_weak(waiting, pack(newer), std::memory_order_release,
                                        std::memory_order_relaxed));
  return {.accepted = true, .replaced = unpack(waiting)};
}

}  // namespace tactus::firmware
