// The ticks and columns of a recording that a user has chosen, for the formats that export_run.h
// writes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "host_tools/export/export_run.h"
#include "host_tools/recording/record_columns.h"
#include "host_tools/recording/recording.h"

namespace tactus::host {

// A column of the output.
struct ChosenColumn {
  std::string name;
  // The index of its value in what read_columns gives.
  std::size_t index = 0;
};

// Returns the columns that the choice's fields stand for; all of them without fields. Throws
// InputError for a field that is not known.
std::vector<ChosenColumn> columns_of(const ExportChoice& choice, std::size_t joints);

// Returns the number of joints of the recorded device, and rewinds the recording. Throws InputError
// if it holds no tick.
std::size_t joints_of(Recording& recording);

// Calls visit(tick) for each chosen tick from the beginning of the recording, and see(time) for
// every thousandth tick that it reads, chosen or not. Returns their number and times; the caller
// adds its number of columns. Throws InputError if there is no tick between the times.
ExportSummary visit_chosen_ticks(Recording& recording, const ExportChoice& choice,
                                 const std::function<void(double time_s)>& see,
                                 const std::function<void(const firmware::RecordedTick&)>& visit);

}  // namespace tactus::host
