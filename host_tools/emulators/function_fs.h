// An emulated USB device behind a real kernel: one vendor-specific interface with a bulk endpoint
// each way, served from this program through Linux' FunctionFS.
//
// The gadget itself is a matter of the shell, before this object is made (names are examples):
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

  // Takes a request without data. Returns false for a stall.
  virtual bool control_out(const hal::UsbSetup& setup) = 0;
  // Returns the answer to a request, or nothing for a stall.
  virtual std::optional<std::vector<std::byte>> control_in(const hal::UsbSetup& setup) = 0;
  // Takes one packet of the host.
  virtual void bulk_out(hal::TimeNs now_ns, std::span<const std::byte> bytes) = 0;
  // Return when there will be a packet for the host, and the packet; kForever and an empty one if
  // there is none.
  virtual hal::TimeNs next_packet_ns() = 0;
  virtual std::vector<std::byte> packet(hal::TimeNs now_ns) = 0;

 protected:
  GadgetDevice() = default;
};

struct GadgetPlace {
  std::filesystem::path function_fs;  // where it is mounted: "/dev/ffs/falcon"
  std::filesystem::path gadget;       // "/sys/kernel/config/usb_gadget/falcon"
  std::string controller = "dummy_udc.0";
};

class FunctionFs {
 public:
  // Serves the device, unplugged at first. Throws InputError, text for a user, when the kernel does
  // not take it.
  FunctionFs(GadgetDevice& device, const GadgetPlace& place);
  FunctionFs(const FunctionFs&) = delete;
  FunctionFs& operator=(const FunctionFs&) = delete;
  ~FunctionFs();

  // Throws InputError as well.
  void plug_in();
  void unplug();

  // Returns the mutex that is held while the device is called. Whoever changes the device from
  // outside holds it too.
  std::mutex& mutex() { return mutex_; }
  // Call it after a change that lets the device send earlier than it said.
  void wake() { changed_.notify_all(); }

 private:
  void bind(const std::string& controller) const;
  void serve_control();
  void answer(const hal::UsbSetup& setup, std::size_t length);
  void serve_out();
  void serve_in();
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
