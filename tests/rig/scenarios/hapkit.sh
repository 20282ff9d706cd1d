#!/bin/sh
# A Hapkit on GPIO lines at 1 kHz pushes against a wall; then its chip is gone.
modprobe gpio-sim-oot
mkdir -p /run && mount -t tmpfs run /run
# Below the interrupts' threads, at 50: a busy program above them would keep them from numbering every edge. One count is
# 3.6e-4 rad at the joint.
priority=40 joint_limit_rad="5e-4 homed_there"
emulated='paddle --pins encoder_a=0,encoder_b=1,direction=2,enable=3,heartbeat=4 --hand pen --path /images/wall_wish_later.csv --ratio 17.4545'
device=hapkit scene=wall
# shellcheck source=tests/rig/scenarios/bus_touch.inc
. /rig/bus_touch.inc

touch_and_check 1 5

emulate unplugged 5 --fault all:unplugged@4
control unplugged 4.7
expect_stop unplugged 'GPIO chip' 1 5
