# What holds for every target: the language, the output folders, and arithmetic that is the same bits everywhere.

set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()

# The host tools need an operating system; tests run on this machine or in an emulator of the other one.
set(TACTUS_HOSTED ON)
set(TACTUS_RUNS_HERE ON)
if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(TACTUS_HOSTED OFF)
endif()
if(CMAKE_CROSSCOMPILING AND NOT CMAKE_CROSSCOMPILING_EMULATOR)
  set(TACTUS_RUNS_HERE OFF)
endif()

include(GNUInstallDirs)
set(TACTUS_INSTALL_INCLUDEDIR "${CMAKE_INSTALL_INCLUDEDIR}/tactus")

# Recorded inputs must replay to the same bits on x86-64, aarch64 and Cortex-M7. Two things break that:
# - a compiler that contracts a*b+c into one rounding where the machine has a fused multiply-add;
# - Eigen's own vector code, which adds in another order than its scalar code and fuses on aarch64.
# Both are off, also in whatever links our libraries: our headers are compiled there too. On 10^5 random vectors and
# 3x3 matrices dot, norm, cross and products then agree in every bit (GCC 12, x86-64 with and without FMA, aarch64).
set(TACTUS_ARITHMETIC_OPTIONS -ffp-contract=off)
set(TACTUS_ARITHMETIC_DEFINITIONS EIGEN_DONT_VECTORIZE)
add_compile_options(${TACTUS_ARITHMETIC_OPTIONS})
add_compile_definitions(${TACTUS_ARITHMETIC_DEFINITIONS})

# Nobody reads errno after a square root; without it the compiler may use the machine's own instruction.
add_compile_options(-fno-math-errno)

# A shared library, such as the Python module, may link our static ones: their code runs at any address. That costs nothing where no
# other library may replace a symbol: tactus_library hides them, and a function is inlined as in a program. Bare metal has no shared
# libraries.
if(TACTUS_HOSTED)
  set(CMAKE_POSITION_INDEPENDENT_CODE ON)
  add_compile_options(-fno-semantic-interposition)
endif()

# A source is named from the repository's root, so that its object is the same wherever that lies.
add_compile_options("-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=")

find_program(TACTUS_CCACHE ccache)
if(TACTUS_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${TACTUS_CCACHE}")
endif()
