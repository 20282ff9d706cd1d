# The part of a toolchain file that Linux boards share: libraries come from the sysroot that toolchains/sysroot.sh makes, and
# programs run here through qemu-user. A sysroot that is not there is made. The file that includes it says TACTUS_TRIPLET, TACTUS_DEBIAN_ARCHITECTURE, TACTUS_EMULATOR.
set(CMAKE_SYSTEM_NAME Linux)

set(TACTUS_SYSROOT "${CMAKE_CURRENT_LIST_DIR}/../../build/sysroot/${TACTUS_DEBIAN_ARCHITECTURE}" CACHE PATH
    "The folder that toolchains/sysroot.sh has made for this processor")
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES TACTUS_SYSROOT)
get_filename_component(CMAKE_SYSROOT "${TACTUS_SYSROOT}" ABSOLUTE)
if(NOT EXISTS "${CMAKE_SYSROOT}/made-of")
  execute_process(
    COMMAND "${CMAKE_CURRENT_LIST_DIR}/../sysroot.sh" "${TACTUS_DEBIAN_ARCHITECTURE}" "${CMAKE_SYSROOT}"
    RESULT_VARIABLE has_failed)
  if(has_failed)
    message(FATAL_ERROR "No libraries for ${TACTUS_DEBIAN_ARCHITECTURE} in ${CMAKE_SYSROOT}; the messages of toolchains/sysroot.sh say why")
  endif()
endif()

set(CMAKE_CXX_COMPILER ${TACTUS_TRIPLET}-g++)
set(CMAKE_LIBRARY_ARCHITECTURE ${TACTUS_TRIPLET})
set(CMAKE_CROSSCOMPILING_EMULATOR "${TACTUS_EMULATOR};-L;${CMAKE_SYSROOT}")

# The sizes of the controller's arrays (rendering/profiles).
set(TACTUS_PROFILE board CACHE STRING "A scene that fits gives the same bits as on a desktop")

# Programs, such as flatc, are this machine's; all else is the sysroot's.
set(CMAKE_FIND_ROOT_PATH "${CMAKE_SYSROOT}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
set(ENV{PKG_CONFIG_SYSROOT_DIR} "${CMAKE_SYSROOT}")
set(ENV{PKG_CONFIG_LIBDIR} "${CMAKE_SYSROOT}/usr/lib/${TACTUS_TRIPLET}/pkgconfig:${CMAKE_SYSROOT}/usr/share/pkgconfig")
