#!/bin/sh
# The Falcon over USB at 1 kHz, which is as fast as its bus goes, beside a busy machine: no missed tick, and awake as early as
# cyclictest.
# long: 100
# soak_twice: csv log
# shellcheck source=tests/rig/scenarios/falcon_gadget.inc
. /rig/falcon_gadget.inc
emulated='falcon --homed --path /images/wish.csv --origin 0.015,-0.075,0.13'
devices=falcon priority=70
# shellcheck source=tests/rig/scenarios/loop.inc
. /rig/loop.inc

begin
sleep 0.6 # until the device has been enumerated
loop usb_1kHz bunny 1000 1.2
cyclic usb 4000 3 bunny 1000
compare
end
