# tactus_library(NAME [CONTROLLER] [SMALL] SOURCES file... [HEADERS file...] [DEPENDS target...] [PRIVATE_DEPENDS target...])
#   One target of the house: library tactus_NAME with the alias tactus::NAME. CONTROLLER marks code that runs in the
#   controller: no exceptions, no run-time type information. SMALL marks code that mostly works before the first tick, which a
#   toolchain may compile for size (TACTUS_SMALL_OPTIONS). A library without sources is an INTERFACE library.
#   A library outside of host_tools/ and tests/ is installed.
# tactus_small(FILE...)
#   Sources of the calling CMakeLists.txt that work before the first tick, of a library whose other sources work in it: compiled as SMALL says.
# tactus_program(NAME SOURCES file... DEPENDS target...)
#   A host program, put in <build>/bin.
# tactus_left_out(WHAT WHY)
#   Notes a part that this build does not have; the end of configuring lists them.
# tactus_embed(TARGET NAME FILE)
#   The text of a file of the repository, for the target's sources: tactus::host::NAME, a std::string_view, in the header that is
#   called as the file with .h behind: #include "host_tools/examples/heart/wish.csv.h".
#
# Every source sees the repository root as its include folder: #include "rendering/geometry/vector.h".

set(TACTUS_WARNINGS
    -Wall -Wextra -Wpedantic -Werror -Wconversion -Wsign-conversion -Wshadow -Wold-style-cast -Wcast-align
    -Wnon-virtual-dtor -Woverloaded-virtual -Wduplicated-cond -Wlogical-op -Wnull-dereference -Wdouble-promotion
    -Wformat=2 -Wimplicit-fallthrough -Wextra-semi
    # A designated initialiser that leaves a member to its default is how configurations are written here.
    -Wno-missing-field-initializers
    # GCC 12 sees an overlap inside std::string that is not there (GCC bug 105651).
    -Wno-restrict)
if(CMAKE_CXX_COMPILER_ID STREQUAL "Clang")
  list(REMOVE_ITEM TACTUS_WARNINGS -Wduplicated-cond -Wlogical-op -Wno-restrict)
endif()
set(TACTUS_CONTROLLER_OPTIONS -fno-exceptions -fno-rtti)
# What libFuzzer follows, and the checks of undefined behaviour that cost the most to compile.
set(TACTUS_FUZZ_OPTIONS -fsanitize=fuzzer-no-link,null,object-size,pointer-overflow)

function(tactus_left_out what why)
  set_property(GLOBAL APPEND PROPERTY TACTUS_LEFT_OUT "${what}: ${why}")
endfunction()

function(tactus_library name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "CONTROLLER;SMALL" "" "SOURCES;HEADERS;DEPENDS;PRIVATE_DEPENDS")
  set(target tactus_${name})
  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES} ${arg_HEADERS})
    set(scope PUBLIC)
    target_compile_options(${target} PRIVATE ${TACTUS_WARNINGS})
    # Tests replace functions of the C library, such as malloc, for the system's libraries too: theirs are seen.
    if(TACTUS_HOSTED AND NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/tests")
      set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
    endif()
    if(arg_CONTROLLER)
      target_compile_options(${target} PRIVATE ${TACTUS_CONTROLLER_OPTIONS})
    endif()
    if(arg_SMALL)
      target_compile_options(${target} PRIVATE ${TACTUS_SMALL_OPTIONS})
    endif()
    if(TACTUS_FUZZ AND arg_CONTROLLER)
      target_compile_options(${target} PRIVATE ${TACTUS_FUZZ_OPTIONS})
    endif()
    target_link_libraries(${target} PRIVATE ${arg_PRIVATE_DEPENDS})
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(tactus::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  target_compile_features(${target} ${scope} cxx_std_23)
  target_include_directories(${target} ${scope}
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>" "$<INSTALL_INTERFACE:${TACTUS_INSTALL_INCLUDEDIR}>")
  target_compile_options(${target} INTERFACE ${TACTUS_ARITHMETIC_OPTIONS})
  target_compile_definitions(${target} INTERFACE ${TACTUS_ARITHMETIC_DEFINITIONS})
  target_link_libraries(${target} ${scope} ${arg_DEPENDS})
  if(NOT CMAKE_CURRENT_SOURCE_DIR MATCHES "^${PROJECT_SOURCE_DIR}/(host_tools|tests)")
    set_property(GLOBAL APPEND PROPERTY TACTUS_LIBRARIES ${target})
  endif()
endfunction()

function(tactus_small)
  # A source with options of its own is compiled by itself.
  if(TACTUS_SMALL_OPTIONS)
    set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${TACTUS_SMALL_OPTIONS}")
  endif()
endfunction()

function(tactus_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;DEPENDS")
  add_executable(${name} ${arg_SOURCES})
  target_compile_options(${name} PRIVATE ${TACTUS_WARNINGS})
  target_link_libraries(${name} PRIVATE ${arg_DEPENDS})
endfunction()

function(tactus_embed target name file)
  file(READ "${PROJECT_SOURCE_DIR}/${file}" text)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${file}")
  set(folder "${CMAKE_CURRENT_BINARY_DIR}/embedded")
  configure_file("${PROJECT_SOURCE_DIR}/toolchains/cmake/embedded_text.h.in" "${folder}/${file}.h" @ONLY)
  target_include_directories(${target} PRIVATE "${folder}")
endfunction()
