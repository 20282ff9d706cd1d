// Files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace tactus::host {

// Writes beside `path` and renames, so that a failure or a reader never meets half of the new file;
// into a pipe directly. Throws InputError naming `path` and the reason: output_place.h refuses it,
// or the system.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// The whole file. Throws InputError naming `path`: missing, a folder, not readable.
std::string read_file(const std::filesystem::path& path);

}  // namespace tactus::host
