// The drivers of this program. A new driver is its include and its line in the list.
#pragma once

#include <tuple>

#include "drivers/cia402_can/registration.h"
#include "drivers/common/can_connection.h"
#include "drivers/falcon_usb/registration.h"
#include "drivers/gpio_axis/registration.h"
#include "drivers/haply_serial/registration.h"
#include "drivers/moteus_canfd/registration.h"
#include "drivers/odrive_can/registration.h"
#include "drivers/vesc_can/registration.h"

namespace tactus::drivers {

// Messages name the drivers in this order.
inline constexpr std::tuple kRegisteredDrivers{
    kODriveDriver,    //
    kMoteusDriver,    //
    kCia402Driver,    //
    kVescDriver,      //
    kGpioAxisDriver,  //
    kFalconDriver,    //
    kHaplyDriver,     //
};

// The kinds of connections.
inline constexpr std::tuple kRegisteredConnections{
    kCanConnection,     //
    kFalconConnection,  //
    kHaplyConnection,   //
    kGpioConnection,    //
};

}  // namespace tactus::drivers
