#include "host_tools/emulators/usb_plug.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

#include "host_tools/input_error.h"

namespace tactus::host {

UsbPlug::UsbPlug(const std::filesystem::path& gadget, std::string controller)
    : file_(gadget / "UDC"), controller_(std::move(controller)) {
  set_plugged_in(true);
}

UsbPlug::~UsbPlug() {
  (void)write("");
}

void UsbPlug::set_plugged_in(bool in) {
  if (in != is_in_ && !write(in ? controller_ : "")) {
    throw InputError(fmt::format("cannot write '{}' to {}: {}; is the gadget set up? see README.md",
                                 in ? controller_ : "", file_.string(), std::strerror(errno)));
  }
  is_in_ = in;
}

bool UsbPlug::write(const std::string& controller) const {
  const int file = ::open(file_.c_str(), O_WRONLY | O_CLOEXEC);
  if (file < 0) {
    return false;
  }
  const std::string line = controller + '\n';
  const bool written = ::write(file, line.data(), line.size()) >= 0;
  const int reason = errno;
  ::close(file);
  errno = reason;
  return written;
}

}  // namespace tactus::host
