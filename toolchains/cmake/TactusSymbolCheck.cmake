# On a bare-metal target every build ends by proving that the static libraries need no heap, exceptions or stdio.
# The names of the forbidden symbols stand in toolchains/check_no_heap.sh.

if(CMAKE_SYSTEM_NAME STREQUAL "Generic")
  set(checked "")
  get_property(libraries GLOBAL PROPERTY TACTUS_LIBRARIES)
  foreach(library IN LISTS libraries)
    get_target_property(type ${library} TYPE)
    if(type STREQUAL "STATIC_LIBRARY")
      list(APPEND checked ${library})
    endif()
  endforeach()

  set(script "${PROJECT_SOURCE_DIR}/toolchains/check_no_heap.sh")
  set(stamp "${PROJECT_BINARY_DIR}/check_no_heap.stamp")
  list(TRANSFORM checked REPLACE "(.+)" "$<TARGET_FILE:\\1>" OUTPUT_VARIABLE files)
  add_custom_command(OUTPUT "${stamp}"
    COMMAND "${script}" "${CMAKE_NM}" ${files}
    COMMAND ${CMAKE_COMMAND} -E touch "${stamp}"
    DEPENDS "${script}" ${checked}
    COMMENT "Looking for heap, exception and stdio symbols" VERBATIM)
  add_custom_target(check_no_heap ALL DEPENDS "${stamp}")
endif()
