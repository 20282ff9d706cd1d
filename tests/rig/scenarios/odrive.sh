# Three ODrive axes touch the bunny; then the plug.
drive=odrive device=odrive_arm options='--nodes 0,1,2'
. /rig/arm_on_can.inc
