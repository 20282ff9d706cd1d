// A program for a board, as the linker wrote it. Host tools, any thread.
#pragma once

#include <filesystem>
#include <string>

namespace tactus::host {

// The program of this repository that an emulator runs.
inline constexpr const char* kDefaultBoardProgram = "build/cortex-m7/bin/mps2_an500";

// Throws InputError, with the remedy, if the file cannot be read, or is no linked program (ELF) for
// an ARM processor of 32 bits.
void check_board_program(const std::filesystem::path& program);

// Returns the path of a program that the shell would run, or an empty path if none has that name.
// `search` is a list of folders like PATH.
std::filesystem::path find_tool(const std::string& name, const std::string& search);
// The same in the PATH of this process.
std::filesystem::path find_tool(const std::string& name);

}  // namespace tactus::host
