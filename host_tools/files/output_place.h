// The place where a program may write what the user named with -o: nothing that exists is lost by a
// wrong name.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>

namespace tactus::host {

// How a program writes an output: in one go or line by line, which a pipe takes too, or as a file
// that it must be able to seek in or replace.
enum class OutputKind : std::uint8_t { may_be_a_pipe, file };

struct OutputPlace {
  std::filesystem::path file;  // with symbolic links followed
  bool is_pipe = false;        // a pipe, socket, terminal or null device, written to as it is
};

// Says where an output goes, and changes nothing. Throws InputError naming `output` and the remedy
// if it is a folder, a device, a link to nothing, a read-only file, or, for `OutputKind::file`, a
// pipe.
OutputPlace output_place(const std::filesystem::path& output, OutputKind kind);

// The name of the file that is written before it takes that place.
std::filesystem::path partial_of(const OutputPlace& place);

// Throws InputError if an output is one of the inputs, by whatever name or link, or the same file
// as another output. Empty paths are skipped. Programs call it before they read or write anything.
void keep_inputs_safe(std::span<const std::filesystem::path> outputs,
                      std::span<const std::filesystem::path> inputs);
void keep_inputs_safe(std::initializer_list<std::filesystem::path> outputs,
                      std::initializer_list<std::filesystem::path> inputs);

// Throws InputError if `output` is a baked scene or device: for programs that write something else.
void keep_images_safe(const std::filesystem::path& output);

// True if the output is this process's standard output: words for the user then belong on stderr.
bool is_standard_output(const std::filesystem::path& output);

}  // namespace tactus::host
