# 64-bit Arm boards under Linux: a Raspberry Pi 4, a Jetson.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(TACTUS_TRIPLET aarch64-linux-gnu)
set(TACTUS_DEBIAN_ARCHITECTURE arm64)
set(TACTUS_EMULATOR qemu-aarch64-static)
include("${CMAKE_CURRENT_LIST_DIR}/cmake/TactusLinuxBoard.cmake")
