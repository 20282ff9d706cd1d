# What holds for every target: the language, the output folders, and arithmetic that is the same bits everywhere.

set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# A bare-metal target has no hosted standard library and no host tools.
if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(TACTUS_HOSTED OFF)
elseif(CMAKE_CROSSCOMPILING)
  set(TACTUS_HOSTED OFF)
else()
  set(TACTUS_HOSTED ON)
endif()

# Recorded inputs must replay to the same bits on x86-64 and aarch64. A compiler that contracts a*b+c into one rounding
# where the machine has a fused multiply-add breaks that, so contraction is off everywhere.
add_compile_options(-ffp-contract=off)

find_program(TACTUS_CCACHE ccache)
if(TACTUS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${TACTUS_CCACHE}")
endif()
