#!/bin/sh
# Two Falcons on two USB ports under one controller at 1 kHz beside a busy machine: no missed tick, and awake as early as cyclictest.
# long: 110
# qemu: -icount shift=0,sleep=off
falcons='left right'
# shellcheck source=tests/rig/scenarios/falcon_gadget.inc
. /rig/falcon_gadget.inc
falcon='falcon --homed --path /images/wish.csv --origin 0.015,-0.075,0.13'
emulated="$falcon --function-fs /dev/ffs/left --gadget /sys/kernel/config/usb_gadget/left --controller dummy_udc.0
$falcon --function-fs /dev/ffs/right --gadget /sys/kernel/config/usb_gadget/right --controller dummy_udc.1"
devices='falcon_left falcon_right' priority=70
# shellcheck source=tests/rig/scenarios/loop.inc
. /rig/loop.inc

begin
sleep 0.6 # until the devices have been enumerated
loop two_1kHz bunny 1000 1.2
cyclic two 4000 3 bunny 1000
compare
end
