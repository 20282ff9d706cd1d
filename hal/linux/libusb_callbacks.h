// The callbacks of libusb and the conversion of its errors, for the two files of LinuxUsbEndpoint.
#pragma once

#include <libusb.h>

#include "hal/error.h"

namespace tactus::hal {

std::unexpected<Error> libusb_failure(int code);

struct LibusbCallbacks {
  static void bulk_done(libusb_transfer* transfer);
  static void control_done(libusb_transfer* transfer);
  static int plugged(libusb_context* context, libusb_device* device, libusb_hotplug_event event,
                     void* endpoint);
  static void descriptor_added(int descriptor, short events, void* endpoint);
  static void descriptor_removed(int descriptor, void* endpoint);
};

}  // namespace tactus::hal
