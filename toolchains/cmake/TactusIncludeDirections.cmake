# Fails the configure step when a file includes a folder that stands above its own:
#   host_tools, tests  ->  firmware  ->  drivers -> hal
#                                    ->  rendering

function(tactus_check_includes folder)
  set(forbidden ${ARGN})
  list(JOIN forbidden "|" alternatives)
  file(GLOB_RECURSE files CONFIGURE_DEPENDS "${PROJECT_SOURCE_DIR}/${folder}/*.h" "${PROJECT_SOURCE_DIR}/${folder}/*.cpp")
  foreach(file IN LISTS files)
    file(STRINGS "${file}" offences REGEX "#[ \t]*include[ \t]*[<\"](\\.\\./)*(tactus/)?(${alternatives})/")
    if(offences)
      file(RELATIVE_PATH shown "${PROJECT_SOURCE_DIR}" "${file}")
      list(GET offences 0 offence)
      message(FATAL_ERROR
        "${shown}: '${offence}' points up. ${folder}/ may not include from: ${forbidden}. "
        "Move the declaration down into ${folder}/ or pass the value in from above.")
    endif()
  endforeach()
endfunction()

tactus_check_includes(rendering hal drivers firmware host_tools tests)
tactus_check_includes(hal rendering drivers firmware host_tools tests)
tactus_check_includes(drivers rendering firmware host_tools tests)
tactus_check_includes(firmware host_tools tests)
tactus_check_includes(host_tools tests)
