# Three ODrive axes touch the bunny; then the plug.
drive='odrive --nodes 0,1,2' device=odrive_arm
. /rig/arm_on_can.inc
