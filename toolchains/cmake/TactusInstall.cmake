# cmake --install: the libraries, their headers and the CMake package, so that another project can
# find_package(tactus) and link tactus::rendering.

include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
