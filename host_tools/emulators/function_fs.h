// Puts an emulated USB device behind a real kernel: one vendor-specific interface with a bulk
// endpoint each way, served from this program through Linux' FunctionFS.
//
// The gadget itself is set up by shell commands before this object is made (names are examples):
//   modprobe -a dummy_hcd libcomposite usb_f_fs      with is_high_speed=0 for a full-speed device
//   cd /sys/kernel/config/usb_gadget && mkdir -p falcon/configs/c.1 falcon/functions/ffs.falcon
//   echo 0x0403 >falcon/idVendor && echo 0xCB48 >falcon/idProduct
//   ln -s falcon/functions/ffs.falcon falcon/configs/c.1
//   mkdir -p /dev/ffs/falcon && mount -t functionfs falcon /dev/ffs/falcon
// tests/rig/scenarios/usb.sh does this. The kernel gives the endpoints the first addresses that the
// controller has: 0x81 and 0x02 on dummy_hcd.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "hal/clock.h"
#include "hal/usb_endpoint.h"

namespace tactus::host {

// The behaviour of a USB device. The threads of FunctionFs call it, one at a time.
class GadgetDevice {
 public:
  GadgetDevice(const GadgetDevice&) = delete;
  GadgetDevice& operator=(const GadgetDevice&) = delete;
  virtual ~GadgetDevice() = default;

  // Handles a request without data. Returns false to stall it.
  virtual bool control_out(const hal::UsbSetup& setup) = 0;
  // Returns the answer to a request; nothing to stall it.
  virtual std::optional<std::vector<std::byte>> control_in(const hal::UsbSetup& setup) = 0;
  // Handles one packet from the host.
  virtual void bulk_out(hal::TimeNs now_ns, std::span<const std::byte> bytes) = 0;
  // Returns when there will be a packet for the host; kForever if never.
  virtual hal::TimeNs next_packet_ns() = 0;
  // Returns the packet for the host; empty if there is none.
  virtual std::vector<std::byte> packet(hal::TimeNs now_ns) = 0;

 protected:
  GadgetDevice() = default;
};

// The kernel's paths of the gadget.
struct GadgetPlace {
  // The mount point of FunctionFS, such as "/dev/ffs/falcon".
  std::filesystem::path function_fs;
  // The gadget's folder, such as "/sys/kernel/config/usb_gadget/falcon".
  std::filesystem::path gadget;
  // The USB device controller, one of /sys/class/udc.
  std::string controller = "dummy_udc.0";
};

// Serves a device from three threads: control requests, packets out, packets in.
class FunctionFs {
 public:
  // Starts unplugged; `device` must outlive it. Throws InputError if the kernel does not accept the
  // descriptors.
  FunctionFs(GadgetDevice& device, const GadgetPlace& place);
  FunctionFs(const FunctionFs&) = delete;
  FunctionFs& operator=(const FunctionFs&) = delete;
  ~FunctionFs();

  // Bind and unbind the gadget. Throw InputError if the kernel refuses.
  void plug_in();
  void unplug();

  // Returns the mutex that is held while the device is called. Code that changes the device from
  // outside must hold it too.
  std::mutex& mutex() { return mutex_; }
  // Wakes the thread that sends. Call it after a change that lets the device send earlier than it
  // had said.
  void wake() { changed_.notify_all(); }

 private:
  // Binds the gadget to a USB controller; an empty name unplugs it. Throws InputError.
  void bind(const std::string& controller) const;
  // The threads: control requests, bulk data from the host and bulk data to the host.
  void serve_control();
  // Hands a control request to the device; stalls what it refuses.
  void answer(const hal::UsbSetup& setup, std::size_t length);
  void serve_out();
  void serve_in();
  // Waits for the device's next packet; empty when the program ends.
  std::vector<std::byte> next_packet();

  GadgetDevice& device_;
  GadgetPlace place_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::atomic<bool> ending_ = false;
  int control_ = -1;
  int in_ = -1;
  int out_ = -1;
  std::vector<std::thread> threads_;
};

}  // namespace tactus::host
