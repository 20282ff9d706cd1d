# 32-bit Arm boards under Linux, ARMv7 and later: a Raspberry Pi 2 or a BeagleBone, or a newer board with a 32-bit system.
set(CMAKE_SYSTEM_PROCESSOR armv7)
set(TACTUS_TRIPLET arm-linux-gnueabihf)
set(TACTUS_DEBIAN_ARCHITECTURE armhf)
set(TACTUS_EMULATOR qemu-arm-static)
# Debian's own choice, which every ARMv7 runs: scalar double-precision arithmetic by the standard, without a fused multiply-add.
# _FILE_OFFSET_BITS: recordings longer than 2 GB, and file systems whose numbers of files have 64 bits.
# -Wno-psabi: notes that GCC 6 passed some structures otherwise; no object here is that old.
set(CMAKE_CXX_FLAGS_INIT "-march=armv7-a+fp -mthumb -mfloat-abi=hard -D_FILE_OFFSET_BITS=64 -Wno-psabi")
include("${CMAKE_CURRENT_LIST_DIR}/cmake/TactusLinuxBoard.cmake")
