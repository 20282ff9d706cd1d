#include "host_tools/benchmark/figures_file.h"

#include <fmt/format.h>
#include <sys/utsname.h>

#include <array>
#include <ctime>
#include <fstream>
#include <thread>
#include <utility>

#include "hal/angle.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr const char* kColumns =
    "mesh,triangles,radius_mm,friction,ticks,median_ns,p99_ns,p999_ns,max_ns,once_p999_ns,"
    "once_max_ns,instructions_mean,instructions_median,instructions_p99,instructions_p999,"
    "instructions_max,contact_ticks,flagged_ticks,peak_candidates,motion,late_ticks,"
    "late_worst_um,late_turn_deg,late_in_a_row,late_turned,"
    "paced_median_ns,paced_p999_ns,cold_median_ns,cold_p999_ns";

// Returns the processor's model. On Arm the kernel names no model; then it is the architecture.
std::string processor(const utsname& system) {
  const std::string key = "model name";
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with(key) && colon != std::string::npos) {
      return line.substr(colon + 2);
    }
  }
  return system.machine;
}

// Returns the date in UTC as YYYY-MM-DD.
std::string today() {
  const std::time_t now = std::time(nullptr);
  std::tm date{};
  ::gmtime_r(&now, &date);
  std::array<char, sizeof "YYYY-MM-DD"> text{};
  return {text.data(), std::strftime(text.data(), text.size(), "%F", &date)};
}

std::string instructions_row(const std::optional<InstructionCount>& count) {
  return count ? fmt::format("{:.0f},{:.0f},{:.0f},{:.0f},{:.0f}", count->mean, count->median,
                             count->p99, count->p999, count->max)
               : ",,,,";
}

std::string single_times_row(const std::optional<SingleTimes>& times) {
  return times ? fmt::format("{:.0f},{:.0f}", times->median_ns, times->p999_ns) : ",";
}

}  // namespace

std::string describe_machine() {
  utsname system{};
  ::uname(&system);
  return fmt::format("{}, {} cores, {} {}; {}; {}", processor(system),
                     std::thread::hardware_concurrency(), system.sysname, system.release,
                     TACTUS_BUILD, today());
}

FiguresFile::FiguresFile(std::filesystem::path path) : path_(std::move(path)) {
  std::ifstream file(path_);
  std::string columns;
  if (!std::getline(file, columns)) {
    write(fmt::format("{}\n", kColumns));
  } else if (columns != kColumns) {
    throw InputError(fmt::format(
        "{}:1: these are not the columns of this version; give another file", path_.string()));
  }
}

void FiguresFile::append(const TouchFigures& figures) {
  const TouchTiming& t = figures.timing;
  std::string text = described_ ? "" : fmt::format("# {}\n", describe_machine());
  described_ = true;
  text += fmt::format(
      "{},{},{:g},{:d},{},{:.0f},{:.0f},{:.0f},{:.0f},{:.0f},{:.0f},{},{},{},{},{},{},{:."
      "1f},{:.1f},{},{},{},{}\n",
      figures.mesh, figures.triangles, 1e3 * figures.radius_m, figures.friction, t.ticks,
      t.median_ns, t.p99_ns, t.p999_ns, t.max_ns, t.once_p999_ns, t.once_max_ns,
      instructions_row(figures.instructions), t.contact_ticks, t.flagged_ticks, t.peak_candidates,
      figures.motion, figures.lateness.late_ticks, 1e6 * figures.lateness.worst_m,
      hal::degrees_of(figures.lateness.worst_turn_rad), figures.lateness.in_a_row,
      figures.lateness.turned_ticks, single_times_row(figures.paced),
      single_times_row(figures.cold));
  write(text);
}

void FiguresFile::write(const std::string& text) {
  std::ofstream file(path_, std::ios::app);
  if (!(file << text << std::flush)) {
    throw InputError(
        fmt::format("{}: cannot be written; check the folder and its permissions", path_.string()));
  }
}

}  // namespace tactus::host
