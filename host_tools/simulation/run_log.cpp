#include "host_tools/simulation/run_log.h"

#include <fmt/format.h>

#include <iterator>
#include <span>

namespace tactus::host {
namespace {

// Bytes that are collected before a write to the disk.
constexpr std::size_t kPiece = std::size_t{1} << 16;

constexpr std::string_view kHeader =
    "t_s,tool_x_m,tool_y_m,tool_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N,"
    "contact,depth_m,"
    "friction_state,commanded_force_x_N,commanded_force_y_N,commanded_force_z_N,wish_x_m,wish_y_m,"
    "wish_z_m,normal_x,normal_y,normal_z,object,touch_flags,mode,faults,limits,hash\n";

void append(std::string& line, const firmware::Triple& v) {
  fmt::format_to(std::back_inserter(line), ",{:.9g},{:.9g},{:.9g}", v[0], v[1], v[2]);
}

}  // namespace

LogFile::LogFile(const std::filesystem::path& path, std::string_view header)
    : file_((keep_images_safe(path), path), OutputKind::may_be_a_pipe), buffer_(header) {}

void LogFile::flush() {
  file_.write(std::as_bytes(std::span(buffer_)));
  buffer_.clear();
}

void LogFile::flush_if_full() {
  if (buffer_.size() > kPiece) {
    flush();
  }
}

void LogFile::close() {
  flush();
  file_.commit();
}

RunCsv::RunCsv(const std::filesystem::path& path) : file_(path, kHeader) {}

void RunCsv::add(const Simulation& simulation, std::size_t device) {
  const firmware::TelemetryRecord& record = simulation.record(device);
  std::string& line = file_.buffer();
  fmt::format_to(std::back_inserter(line), "{:.9g}", record.time_s);
  append(line, record.tool_p_W);
  append(line, record.proxy_W);
  append(line, record.force_rendered_W);
  fmt::format_to(std::back_inserter(line), ",{},{:.9g},{}", static_cast<int>(record.contact),
                 record.depth_m, static_cast<int>(record.friction));
  append(line, record.force_commanded_W);
  append(line, firmware::to_triple(simulation.wish_W(device)));
  append(line, record.normal_W);
  if (record.contact == rendering::ContactKind::none) {
    line += ',';
  } else {
    fmt::format_to(std::back_inserter(line), ",{}", record.object);
  }
  fmt::format_to(std::back_inserter(line), ",{}", record.touch_flags);
  fmt::format_to(std::back_inserter(line), ",{},{},{},{:016x}\n", static_cast<int>(record.mode),
                 record.faults, record.limits, record.state_hash);
  file_.flush_if_full();
}

HashLog::HashLog(const std::filesystem::path& path) : file_(path, "tick,hash\n") {}

void HashLog::add(const firmware::TelemetryRecord& record) {
  fmt::format_to(std::back_inserter(file_.buffer()), "{},{:016x}\n", record.tick,
                 record.state_hash);
  file_.flush_if_full();
}

}  // namespace tactus::host
