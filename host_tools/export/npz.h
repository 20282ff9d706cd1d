// Writes ticks as NPZ, the file of numpy.savez: a zip archive with one array in the format NPY for
// each column (numpy.lib.format describes it).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>

#include "host_tools/export/chosen_ticks.h"
#include "host_tools/export/export_run.h"
#include "host_tools/recording/recording.h"

namespace tactus::host {

// The memory for columns that are collected.
struct NpzRoom {
  // The memory of all columns together; one column may take more.
  std::size_t room_bytes = std::size_t{256} << 20U;
};

// Writes the chosen ticks. Numbers are float64, int64 or uint64, as in the record; the state hash
// is uint64; words are texts of the longest one's length. Columns are collected before they are
// written, as many at once as there is room for; the recording is read as often as that needs.
// Throws InputError like export_ticks, and if the output is a pipe, since an archive's table of
// contents is written by seeking.
ExportSummary write_npz(Recording& recording, const ExportChoice& choice,
                        std::span<const ChosenColumn> columns, const std::filesystem::path& output,
                        const std::function<void(double time_s)>& see, const NpzRoom& room = {});

}  // namespace tactus::host
