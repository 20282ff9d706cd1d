// A controller of any number of devices on the heap, for programs on the host. It never runs in the
// control loop of a device.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "firmware/control/controller.h"

namespace tactus::host {

// Owns a controller and the storage of its devices beyond the first one.
class HeapController {
 public:
  // Makes a controller of 1 to kMaxTools devices, which is not configured.
  explicit HeapController(std::size_t devices)
      : more_devices_(devices - 1),
        more_tools_(devices - 1),
        controller_(std::make_unique<firmware::Controller>(more_devices_, more_tools_)) {}

  [[nodiscard]] firmware::Controller& operator*() const { return *controller_; }
  [[nodiscard]] firmware::Controller* operator->() const { return controller_.get(); }

 private:
  std::vector<firmware::DeviceController> more_devices_;
  std::vector<rendering::ToolSlot> more_tools_;
  // It has more than two megabytes, too many for the stack.
  std::unique_ptr<firmware::Controller> controller_;
};

}  // namespace tactus::host
