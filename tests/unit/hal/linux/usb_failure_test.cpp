#include <gtest/gtest.h>

#include <utility>

#include "hal/linux/libusb_callbacks.h"

namespace tactus::hal {
namespace {

TEST(UsbFailure, TellsWhatACallerMayActUpon) {
  for (const auto& [libusb_code, code] :
       {std::pair{LIBUSB_ERROR_NO_DEVICE, ErrorCode::disconnected},
        std::pair{LIBUSB_ERROR_NOT_FOUND, ErrorCode::disconnected},
        std::pair{LIBUSB_ERROR_BUSY, ErrorCode::busy},
        std::pair{LIBUSB_ERROR_ACCESS, ErrorCode::not_permitted},
        std::pair{LIBUSB_ERROR_NO_MEM, ErrorCode::no_memory},
        std::pair{LIBUSB_ERROR_PIPE, ErrorCode::io}}) {
    EXPECT_EQ(libusb_failure(libusb_code).error(), (Error{code, libusb_code}));
  }
}

}  // namespace
}  // namespace tactus::hal
