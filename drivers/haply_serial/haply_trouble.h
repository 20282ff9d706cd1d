// The faults of a Haply board in words, each with a remedy.
#pragma once

#include "drivers/axis.h"

namespace tactus::drivers {

inline constexpr Trouble kHaplyUnplugged{
    .what = "the Haply board is unplugged",
    .remedy = "plug it in, reset, put the arms in their home pose and home"};
inline constexpr Trouble kHaplyTransferFailed{
    .what = "a transfer to the Haply board failed",
    .remedy = "check the cable, reset, put the arms in their home pose and home"};
inline constexpr Trouble kHaplyNotTaking{
    .what = "the Haply board takes no more commands",
    .remedy = "unplug it and plug it in, reset, put the arms in their home pose and home"};
inline constexpr Trouble kHaplySilent{
    .what = "the Haply board does not answer",
    .remedy = "check its power supply, reset, put the arms in their home pose and home"};
inline constexpr Trouble kHaplyGarbled{
    .what = "the Haply board's answers make no sense",
    .remedy = "check the device id and the cable, reset, put the arms in their home pose and home"};
inline constexpr Trouble kHaplyJumped{
    .what = "the Haply's arms seem to jump",
    .remedy = "check the encoders' cables, reset, put the arms in their home pose and home"};
inline constexpr Trouble kHaplySetupWrong{
    .what = "the Haply board did not take its setup",
    .remedy = "check that the port and the device id are the board's, keep the arms still, reset"};
inline constexpr Trouble kHaplyNoWatchdog{
    .what = "the Haply board keeps its torque when the host dies: it has no watchdog",
    .remedy =
        "put a switch within reach that cuts its motor supply, and say unproven_watchdog = "
        "true at its connection"};

}  // namespace tactus::drivers
