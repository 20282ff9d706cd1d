# Fails when a file includes a folder that stands above its own:
#   host_tools, tests  ->  firmware  ->  drivers -> hal
#                                    ->  rendering
# or when a portable room of firmware/ includes what needs Linux, or a room of rendering/ one that is built on it.
# Checked when the project is configured, and again by every build that follows a change to a source file.

if(CMAKE_SCRIPT_MODE_FILE)
  set(root "${TACTUS_ROOT}")
else()
  set(root "${PROJECT_SOURCE_DIR}")
endif()

function(tactus_check_includes folder)
  set(forbidden ${ARGN})
  list(JOIN forbidden "|" alternatives)
  if(CMAKE_SCRIPT_MODE_FILE)
    file(GLOB_RECURSE files "${root}/${folder}/*.h" "${root}/${folder}/*.cpp")
  else()
    file(GLOB_RECURSE files CONFIGURE_DEPENDS "${root}/${folder}/*.h" "${root}/${folder}/*.cpp")
  endif()
  foreach(file IN LISTS files)
    file(STRINGS "${file}" offences REGEX "#[ \t]*include[ \t]*[<\"](\\.\\./)*(tactus/)?(${alternatives})/")
    if(offences)
      file(RELATIVE_PATH shown "${root}" "${file}")
      list(GET offences 0 offence)
      message(FATAL_ERROR
        "${shown}: '${offence}' points up. ${folder}/ may not include from: ${forbidden}. "
        "Move the declaration down into ${folder}/ or pass the value in from above.")
    endif()
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TACTUS_CHECKED_FILES ${files})
endfunction()

tactus_check_includes(rendering hal drivers firmware host_tools tests)
tactus_check_includes(hal rendering drivers firmware host_tools tests)
tactus_check_includes(drivers rendering firmware host_tools tests)
tactus_check_includes(firmware host_tools tests)
tactus_check_includes(host_tools tests)
foreach(room IN ITEMS bare_metal commands commissioning configuration control device_file kinematics line safety telemetry)
  tactus_check_includes(firmware/${room} hal/linux firmware/linux)
endforeach()

# The rooms of rendering/, the lowest first: none includes one that follows it.
set(higher_rooms profiles geometry surface friction material effects objects contact bodies needle world state scene)
while(higher_rooms)
  list(POP_FRONT higher_rooms room)
  if(higher_rooms)
    list(TRANSFORM higher_rooms PREPEND rendering/ OUTPUT_VARIABLE forbidden)
    tactus_check_includes(rendering/${room} ${forbidden})
  endif()
endwhile()

if(NOT CMAKE_SCRIPT_MODE_FILE)
  get_property(files GLOBAL PROPERTY TACTUS_CHECKED_FILES)
  set(stamp "${PROJECT_BINARY_DIR}/include_directions.stamp")
  add_custom_command(OUTPUT "${stamp}"
    COMMAND ${CMAKE_COMMAND} "-DTACTUS_ROOT=${root}" -P "${CMAKE_CURRENT_LIST_FILE}"
    COMMAND ${CMAKE_COMMAND} -E touch "${stamp}"
    DEPENDS "${CMAKE_CURRENT_LIST_FILE}" ${files}
    COMMENT "Checking the direction of includes" VERBATIM)
  add_custom_target(include_directions ALL DEPENDS "${stamp}")
endif()
