// The transfers that a simulated USB endpoint has accepted and not ended.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "hal/clock.h"
#include "hal/usb_endpoint.h"

namespace tactus::hal {

// The transfers in flight, oldest first.
class UsbFlights {
 public:
  // A submitted transfer.
  struct Flight {
    UsbTransfer* transfer = nullptr;
    // The time at which the device has the data of a bulk-out.
    TimeNs due_ns = 0;
  };

  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] bool full() const { return count_ == flights_.size(); }
  // Adds a transfer; the list is not full.
  void add(const Flight& flight) { flights_[count_++] = flight; }
  // Removes a transfer that is in the list.
  void remove(const UsbTransfer& transfer) {
    const auto flights = std::span(flights_).first(count_);
    const auto found = std::ranges::find(flights, &transfer, &Flight::transfer);
    std::ranges::move(found + 1, flights.end(), found);
    --count_;
  }
  // Returns the oldest transfer; the list is not empty.
  [[nodiscard]] UsbTransfer& oldest() const { return *flights_[0].transfer; }
  // Returns the oldest transfer of one direction; null if there is none.
  [[nodiscard]] const Flight* oldest(UsbDirection direction) const {
    const auto flights = std::span(flights_).first(count_);
    const auto found = std::ranges::find_if(flights, [direction](const Flight& flight) {
      return flight.transfer->direction() == direction;
    });
    return found == flights.end() ? nullptr : &*found;
  }

 private:
  std::array<Flight, kMaxUsbTransfersInFlight> flights_{};
  std::size_t count_ = 0;
};

}  // namespace tactus::hal
