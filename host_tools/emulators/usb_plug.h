// The cable of a USB gadget of this machine's kernel, pulled and put back by a program.
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host {

class UsbPlug {
 public:
  // Plugs in. `gadget` is its folder below /sys/kernel/config/usb_gadget, `controller` one of
  // /sys/class/udc. Throws InputError, text for a user, when the kernel refuses.
  UsbPlug(const std::filesystem::path& gadget, std::string controller);
  UsbPlug(const UsbPlug&) = delete;
  UsbPlug& operator=(const UsbPlug&) = delete;
  ~UsbPlug();

  // Plugs in or out; does nothing if the plug is there already.
  void set_plugged_in(bool in);

 private:
  bool write(const std::string& controller) const;

  std::filesystem::path file_;
  std::string controller_;
  bool is_in_ = false;
};

}  // namespace tactus::host
