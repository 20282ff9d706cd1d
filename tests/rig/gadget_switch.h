// Plugs a configfs gadget in and out.
#pragma once

#include <fstream>
#include <string>

namespace tactus::rig {

class GadgetSwitch {
 public:
  explicit GadgetSwitch(const std::string& gadget)
      : file_("/sys/kernel/config/usb_gadget/" + gadget + "/UDC") {}
  GadgetSwitch(const GadgetSwitch&) = delete;
  GadgetSwitch& operator=(const GadgetSwitch&) = delete;
  ~GadgetSwitch() { unplug(); }

  void plug_in() const { write("dummy_udc.0\n"); }
  void unplug() const { write("\n"); }

 private:
  void write(const std::string& line) const { std::ofstream(file_) << line << std::flush; }

  std::string file_;
};

}  // namespace tactus::rig
