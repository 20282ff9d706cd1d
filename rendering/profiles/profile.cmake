# TACTUS_PROFILE chooses the sizes of the controller's fixed arrays: one of the headers of this folder. A new profile is a header
# NAME.h with the constant kNameProfile, and its name here.
set(TACTUS_PROFILES desktop board microcontroller)

set(TACTUS_PROFILE desktop CACHE STRING "The sizes of the controller's fixed arrays: a header of rendering/profiles")
set_property(CACHE TACTUS_PROFILE PROPERTY STRINGS ${TACTUS_PROFILES})
if(NOT TACTUS_PROFILE IN_LIST TACTUS_PROFILES)
  list(JOIN TACTUS_PROFILES ", " known)
  message(FATAL_ERROR "TACTUS_PROFILE is '${TACTUS_PROFILE}', and the profiles are: ${known}. Choose one of them: cmake -D TACTUS_PROFILE=board")
endif()

# board -> kBoardProfile, my_arm -> kMyArmProfile.
function(tactus_profile_constant profile constant)
  set(words "")
  string(REPLACE "_" ";" parts "${profile}")
  foreach(part IN LISTS parts)
    string(SUBSTRING "${part}" 0 1 first)
    string(SUBSTRING "${part}" 1 -1 rest)
    string(TOUPPER "${first}" first)
    string(APPEND words "${first}${rest}")
  endforeach()
  set(${constant} "k${words}Profile" PARENT_SCOPE)
endfunction()

set(includes "")
set(constants "")
foreach(profile IN LISTS TACTUS_PROFILES)
  tactus_profile_constant(${profile} constant)
  list(APPEND includes "#include \"rendering/profiles/${profile}.h\"")
  list(APPEND constants ${constant})
endforeach()
tactus_profile_constant(${TACTUS_PROFILE} TACTUS_PROFILE_CONSTANT)
list(JOIN includes "\n" TACTUS_PROFILE_INCLUDES)
list(JOIN constants ", " TACTUS_PROFILE_CONSTANTS)

# Everything that includes a header of the controller gets this one with it, in the build and where it is installed.
set(TACTUS_PROFILE_FOLDER "${CMAKE_CURRENT_BINARY_DIR}/generated")
configure_file("${CMAKE_CURRENT_LIST_DIR}/chosen_profile.h.in"
  "${TACTUS_PROFILE_FOLDER}/rendering/profiles/chosen_profile.h" @ONLY)
install(FILES "${TACTUS_PROFILE_FOLDER}/rendering/profiles/chosen_profile.h"
        DESTINATION "${TACTUS_INSTALL_INCLUDEDIR}/rendering/profiles")
