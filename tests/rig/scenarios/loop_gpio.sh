#!/bin/sh
# A Hapkit on GPIO lines at 1, 2, 4 and 8 kHz beside a busy machine: no missed tick, and awake as early as cyclictest.
# long: 110
# soak_twice: csv log
modprobe gpio-sim-oot
mkdir -p /run && mount -t tmpfs run /run
# The hand holds the paddle upright, where it is homed at the start of each loop.
emulated='paddle --pins encoder_a=0,encoder_b=1,direction=2,enable=3,heartbeat=4 --ratio 17.4545'
devices=hapkit priority=40
# shellcheck source=tests/rig/scenarios/loop.inc
. /rig/loop.inc

begin
loop gpio_1kHz wall 1000 0.6
loop gpio_2kHz wall 2000 0.6
loop gpio_4kHz wall 4000 0.6
loop gpio_8kHz wall 8000 0.6
cyclic gpio 8000 3 wall 2000
compare
end
