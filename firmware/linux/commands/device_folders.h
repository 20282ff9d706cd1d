// Makes the folders of a controller's devices beside its own, RUN_DIR: RUN_DIR/2 has the sockets of
// the second device, and RUN_DIR/by-name a symbolic link for each device. For the start of a
// program; not real time.
#pragma once

#include <sys/stat.h>

#include <span>
#include <string_view>

namespace tactus::firmware {

// The folder of the links in RUN_DIR.
inline constexpr const char* kNamesFolder = "by-name";

// Makes the folder, if there is none, with the group and the rights of `like`. Returns 0 or errno.
int make_device_folder(const char* folder, const struct stat& like);

// Links RUN_DIR/by-name/NAME to the folder of the device of that name, and removes the links of an
// earlier run. `names` has those of all devices in their order. A name that several devices share,
// or that no file can have, gets no link. Returns 0 or errno.
int link_device_names(const char* run_dir, std::span<const std::string_view> names);

// Returns the name of the device whose image is `path`: the file's name without its extension.
std::string_view device_name_of(std::string_view path);

}  // namespace tactus::firmware
