// Reads and writes whole files at once. Every tool that writes an image, a table or a report in one
// go uses it; a reader sees either the old file or the complete new one.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

namespace tactus::host {

// Writes `bytes` to a temporary file beside `path` and renames it to `path`, so that a failure
// leaves the old file and no reader sees half of the new one. A pipe or terminal is written to
// directly. Throws InputError that names `path` and the reason: output_place() refuses it, or the
// system does.
void write_file_atomically(const std::filesystem::path& path, std::span<const std::byte> bytes);

// Returns the content of a file. Throws InputError that names `path` if it is missing, is a folder
// or cannot be read.
std::string read_file(const std::filesystem::path& path);

}  // namespace tactus::host
