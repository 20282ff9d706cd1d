// Finds a GPIO chip by its label or its path, and converts the errors of libgpiod. Any thread; not
// real time.
#pragma once

#include <gpiod.h>

#include <memory>
#include <string_view>

#include "hal/error.h"

namespace tactus::hal {

// An open chip, which is closed when it is destroyed.
struct CloseGpioChip {
  void operator()(gpiod_chip* chip) const { gpiod_chip_close(chip); }
};
using LinuxGpioChip = std::unique_ptr<gpiod_chip, CloseGpioChip>;

// Converts the errno of a libgpiod call:
//   disconnected   ENODEV: the chip is gone
//   busy           EBUSY
//   not_supported  E2BIG, ENXIO, EOPNOTSUPP and the kernel's own ENOTSUPP, ENOSYS, EINVAL: the line
//                  or the kernel cannot do it
//   not_found      ENOENT, ENOTTY: there is no GPIO chip of that path
//   not_permitted  EACCES, EPERM
//   no_memory      ENOMEM
//   io             the rest
std::unexpected<Error> gpio_failure(int errno_value);

// Opens a chip. A name with a slash is a path ("/dev/gpiochip0"); any other is the label that the
// chip's driver gives it ("pinctrl-bcm2711"). The numbers in paths depend on the order in which
// drivers load; labels do not. Not real time.
//   not_found         no chip has that label, or nothing is at the path
//   invalid_argument  two chips have that label: use a path, such as a link that a udev rule makes
//   not_permitted, no_memory, io
Result<LinuxGpioChip> open_gpio_chip(std::string_view label_or_path);

// Returns the number of lines of the chip; 0 if it is not known.
std::size_t line_count_of(gpiod_chip& chip);

}  // namespace tactus::hal
