// The faults of a Falcon in words, each with a remedy.
#pragma once

#include "drivers/axis.h"
#include "drivers/falcon_usb/bring_up.h"

namespace tactus::drivers {

inline constexpr Trouble kFalconUnplugged{
    .what = "the Falcon is unplugged",
    .remedy = "plug in its USB cable and its power supply, then reset"};
inline constexpr Trouble kFalconTransferFailed{
    .what = "a USB transfer to the Falcon failed",
    .remedy = "check the cable, leave out hubs, then reset"};
inline constexpr Trouble kFalconSilent{
    .what = "the Falcon does not answer",
    .remedy = "check its power supply and the host's load, then reset"};
inline constexpr Trouble kFalconNotTaking{.what = "the Falcon takes no more packets",
                                          .remedy = "switch it off and on, then reset"};
inline constexpr Trouble kFalconGarbled{.what = "the Falcon's packets arrive damaged",
                                        .remedy = "check the cable, leave out hubs, then reset"};
inline constexpr Trouble kFalconJumped{
    .what = "the Falcon's arms seem to jump",
    .remedy = "check the cable; reset, pull the grip out and push it in"};
inline constexpr Trouble kFalconReferenceLost{
    .what = "the Falcon lost its reference",
    .remedy = "check its power supply; reset, pull the grip out and push it in"};

inline constexpr Trouble kFalconNoWatchdog{
    .what = "nobody has shown that the Falcon's motors stop when the host dies",
    .remedy =
        "keep its power switch within reach and say unproven_watchdog = true at its "
        "connection"};

// Returns the fault of a bring-up, or an empty Trouble while it is under way or when it is up.
Trouble trouble_of(FalconBringUp::Outcome outcome);

}  // namespace tactus::drivers
