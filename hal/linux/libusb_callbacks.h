// The callbacks of libusb and the conversion of its errors, for the two files of LinuxUsbEndpoint.
#pragma once

#include <libusb.h>

#include "hal/error.h"

namespace tactus::hal {

// Converts a LIBUSB_ERROR_* of a call:
//   disconnected   NO_DEVICE, NOT_FOUND
//   busy           BUSY: another program has claimed the interface
//   not_permitted  ACCESS
//   no_memory      NO_MEM
//   io             the rest
std::unexpected<Error> libusb_failure(int code);

// The functions that libusb calls, from within the calls of LinuxUsbEndpoint and in its thread.
// Each gets the endpoint, or the transfer whose user_data leads to it.
struct LibusbCallbacks {
  static void bulk_done(libusb_transfer* transfer);
  static void control_done(libusb_transfer* transfer);
  static int plugged(libusb_context* context, libusb_device* device, libusb_hotplug_event event,
                     void* endpoint);
  static void descriptor_added(int descriptor, short events, void* endpoint);
  static void descriptor_removed(int descriptor, void* endpoint);
};

}  // namespace tactus::hal
