// Compares the tick of this program with that of another build of it, such as another commit's, in
// one run: the two take turns, so that what the machine does besides falls on both.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tactus::host {

// The figures of one row of a figures file (figures_file.h) that are compared.
struct FigureRow {
  std::string mesh;
  // 0 in a file without that column.
  double triangles = 0.0;
  double radius_mm = 0.0;
  // The tool's motion, "hand" or "jumps"; "jumps" in a file without that column.
  std::string motion = "jumps";
  double median_ns = 0.0;
  double p99_ns = 0.0;
  double p999_ns = 0.0;
  // The median of a tick's instructions; nothing if they were not counted.
  std::optional<double> instructions;
  // The number of late ticks; nothing in a file without that column.
  std::optional<double> late_ticks;
};

// The same row of two programs.
struct ComparedRow {
  FigureRow here;
  FigureRow there;
};

// Reads a figures file of this version or of an earlier one. Throws InputError with file and line
// if a column is missing or a field is no number.
std::vector<FigureRow> read_figures(const std::filesystem::path& file);

// Keeps the least time of each row. `more` holds another run of the same rows in the same order.
// Throws InputError if it does not.
void keep_least(std::vector<FigureRow>& rows, const std::vector<FigureRow>& more);

// Returns the rows that both have, in the order of `here`.
std::vector<ComparedRow> paired(const std::vector<FigureRow>& here,
                                const std::vector<FigureRow>& there);

// Returns the program `tactus` in a folder or in its bin/. Throws InputError with the remedy if
// there is none.
std::filesystem::path program_in(const std::filesystem::path& folder);

// A comparison of this program with the one in `folder`.
struct Comparison {
  std::filesystem::path folder;
  // The options that say what is measured, as words of a shell; both programs get them.
  std::string words;
  // The number of turns of each program, at least 1. Instructions are counted in the first.
  std::size_t turns = 5;
  bool instructions = false;
  // Called before each run with its turn, from 1, and whether this program runs.
  std::function<void(std::size_t turn, bool here)> progress;
};

// Runs both programs in turn. Throws InputError if one fails, with the command to see why.
std::vector<ComparedRow> compare(const Comparison& comparison);

}  // namespace tactus::host
