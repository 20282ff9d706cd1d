# 64-bit RISC-V under Linux: the portable core and its tests. Debian 12 has a compiler and a C library for this processor, and no
# packages of the libraries that tactus and tactusd are linked from.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR riscv64)

set(CMAKE_C_COMPILER riscv64-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER riscv64-linux-gnu-g++)
set(CMAKE_LIBRARY_ARCHITECTURE riscv64-linux-gnu)
set(CMAKE_CROSSCOMPILING_EMULATOR "qemu-riscv64-static;-L;/usr/riscv64-linux-gnu")

# The sizes of the controller's arrays (rendering/profiles).
set(TACTUS_PROFILE board CACHE STRING "A scene that fits gives the same bits as on a desktop")
set(TACTUS_HOST_TOOLS OFF CACHE BOOL "The libraries of the host tools are not to be had")

set(CMAKE_FIND_ROOT_PATH /usr/riscv64-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(Eigen3_DIR /usr/share/eigen3/cmake CACHE PATH "Eigen is headers only: this machine's serve every target")
# Debian's source of GoogleTest is compiled for this processor.
set(TACTUS_GOOGLETEST_SOURCE /usr/src/googletest)
