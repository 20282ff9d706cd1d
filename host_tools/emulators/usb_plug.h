// The cable of a USB gadget of this machine's kernel, plugged and unplugged by a program.
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host {

// Binds the gadget to a controller of the kernel, and unbinds it at the end.
class UsbPlug {
 public:
  // Plugs in. `gadget` is its folder below /sys/kernel/config/usb_gadget, `controller` one of
  // /sys/class/udc. Throws InputError if the kernel refuses.
  UsbPlug(const std::filesystem::path& gadget, std::string controller);
  UsbPlug(const UsbPlug&) = delete;
  UsbPlug& operator=(const UsbPlug&) = delete;
  ~UsbPlug();

  // Plugs in or out; does nothing if the plug is in that state. Throws InputError.
  void set_plugged_in(bool in);

 private:
  bool write(const std::string& controller) const;

  std::filesystem::path file_;
  std::string controller_;
  bool is_in_ = false;
};

}  // namespace tactus::host
