// Files that are there whole or not at all.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace tactus::host {

// Writes beside `path` and renames, so that a failure, or a controller that has the old file
// mapped, never meets half of the new one. Throws InputError naming `path` and the system's reason.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// The whole file. Throws InputError naming `path`: missing, a folder, not readable.
std::string read_file(const std::filesystem::path& path);

}  // namespace tactus::host
