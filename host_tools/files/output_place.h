// Decides where a program may write the output that the user named with -o, so that a wrong name
// never destroys a file that exists. Every verb of `tactus` that writes calls it before it reads or
// writes anything.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <span>

namespace tactus::host {

// How a program writes an output. `may_be_a_pipe`: in one go or line by line, so that a pipe will
// do. `file`: the program must be able to seek in the output or to replace it.
enum class OutputKind : std::uint8_t { may_be_a_pipe, file };

struct OutputPlace {
  // The output with symbolic links followed.
  std::filesystem::path file;
  // True for a pipe, socket, terminal or null device: it is written to directly, without a
  // temporary file.
  bool is_pipe = false;
};

// Returns where an output goes, and changes nothing on the disk. Throws InputError that names
// `output` and the remedy if it is a folder, a device, a link to nothing, a file without write
// permission, "-", or, for `OutputKind::file`, a pipe.
OutputPlace output_place(const std::filesystem::path& output, OutputKind kind);

// Returns the name of the temporary file beside `place`: it holds this process's number, so that
// two programs that write the same output do not share it.
std::filesystem::path partial_of(const OutputPlace& place);

// Throws InputError if an output is the same file as one of the inputs, under any name or link, or
// as another output. Empty paths are skipped.
void keep_inputs_safe(std::span<const std::filesystem::path> outputs,
                      std::span<const std::filesystem::path> inputs);
void keep_inputs_safe(std::initializer_list<std::filesystem::path> outputs,
                      std::initializer_list<std::filesystem::path> inputs);

// Throws InputError if `output` is a baked scene or device. Programs that write anything else call
// it, so that a slip of the user does not replace an image by a table.
void keep_images_safe(const std::filesystem::path& output);

// Throws InputError if a recording may not be written to the file: its name does not end in .mcap
// or .csv, there is a file and it may not be overwritten, or output_place() refuses it. Programs
// ask before the run, which may take long. An empty name is no recording.
void check_recording_place(const std::filesystem::path& file, bool may_overwrite);

// Makes the folder of a file if it is missing. Throws InputError that names the folder.
void make_folder_of(const std::filesystem::path& file);

// Returns the file of one of several tools: `file` itself for tool 0, run.2.csv beside run.csv for
// tool 1, and so on. An empty name stays empty.
std::filesystem::path file_of_tool(const std::filesystem::path& file, std::size_t tool);

// Throws InputError if an output that several tools share is a pipe: it takes the rows of one. An
// empty name is no output.
void refuse_shared_pipe(const std::filesystem::path& output, std::size_t tools);

// Returns true if the output is this process's standard output. Text for the user then belongs on
// stderr, so that it does not mix with the rows.
bool is_standard_output(const std::filesystem::path& output);

}  // namespace tactus::host
