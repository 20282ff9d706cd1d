#!/bin/sh
# Three ODrive axes touch the bunny; then the plug.
# long: 60
drive='odrive --nodes 0,1,2 --encoder multi_turn' device=odrive_arm
# shellcheck source=tests/rig/scenarios/arm_on_can.inc
. /rig/arm_on_can.inc
