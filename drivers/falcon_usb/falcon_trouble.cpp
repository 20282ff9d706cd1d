#include "drivers/falcon_usb/falcon_trouble.h"

namespace tactus::drivers {

Trouble trouble_of(FalconBringUp::Outcome outcome) {
  switch (outcome) {
    case FalconBringUp::Outcome::refuses_settings:
      return {.what = "the Falcon refuses its serial settings",
              .remedy = "unplug it, plug it in again, then reset"};
    case FalconBringUp::Outcome::no_firmware:
      return {.what = "the Falcon has no firmware",
              .remedy = "give the firmware file of its maker's software, then reset"};
    case FalconBringUp::Outcome::no_loader:
      return {.what = "the Falcon's firmware loader does not answer",
              .remedy = "switch it off and on, then reset"};
    case FalconBringUp::Outcome::load_failed:
      return {.what = "the Falcon did not take the firmware",
              .remedy = "leave out hubs, switch it off and on, then reset"};
    case FalconBringUp::Outcome::firmware_silent:
      return {.what = "the Falcon took the firmware and does not answer",
              .remedy = "check that the file is a firmware image for it, then reset"};
    case FalconBringUp::Outcome::under_way:
    case FalconBringUp::Outcome::up:
      break;
  }
  return {};
}

}  // namespace tactus::drivers
