# Arm Cortex-M7 bare metal with the double-precision FPU (STM32H7, i.MX RT1060): static libraries.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR cortex-m7)

set(CMAKE_CXX_COMPILER arm-none-eabi-g++)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)  # there is no start-up code to link a program with

# The sizes of the controller's arrays (rendering/profiles).
set(TACTUS_PROFILE microcontroller CACHE STRING "The controller and a scene image fit into a few hundred kilobytes")

# nano.specs: newlib for small memories. Statics are built before the first interrupt: they need no guards.
# -Wno-psabi: notes that GCC 6 passed some structures otherwise; no object here is that old.
set(CMAKE_CXX_FLAGS_INIT
    "-mcpu=cortex-m7 -mthumb -mfpu=fpv5-d16 -mfloat-abi=hard --specs=nano.specs \
-fno-exceptions -fno-rtti -fno-threadsafe-statics -ffunction-sections -fdata-sections -Wno-psabi")
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG" CACHE STRING "The flags of what runs in every tick")
# Libraries that mostly work before the first tick: a fifth of their flash is worth more than their time.
set(TACTUS_SMALL_OPTIONS -Os)

set(CMAKE_FIND_ROOT_PATH /usr/lib/arm-none-eabi)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(Eigen3_DIR /usr/share/eigen3/cmake CACHE PATH "Eigen is headers only: this machine's serve every target")
