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
  // A bulk or a control transfer has ended.
  static void bulk_done(libusb_transfer* transfer);
  static void control_done(libusb_transfer* transfer);
  // A device of our vendor and product came or went. Returns 0, so that libusb goes on reporting.
  static int plugged(libusb_context* context, libusb_device* device, libusb_hotplug_event event,
                     void* endpoint);
  // The list of descriptors on which libusb waits has changed.
  static void descriptor_added(int descriptor, short events, void* endpoint);
  static void descriptor_removed(int descriptor, void* endpoint);
};

}  // namespace tactus::hal
