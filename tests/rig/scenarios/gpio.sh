#!/bin/sh
# libgpiod 2: the contract and every error of GpioLines on gpio-sim; a quadrature encoder at its limit; the axis driver against
# its emulated device.
modprobe gpio-sim-oot
exec gpio_rig_tests --gtest_brief=1
