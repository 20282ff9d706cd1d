#!/bin/sh
# Three moteus servos on CAN FD touch the bunny; then the plug.
# long: 75
drive='moteus --nodes 1,2,3 --timeout-mode 0' device=moteus_arm wish=wish_later later=2
# shellcheck source=tests/rig/scenarios/arm_on_can.inc
. /rig/arm_on_can.inc
