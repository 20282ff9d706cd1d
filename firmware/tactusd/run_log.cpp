#include "firmware/tactusd/run_log.h"

#include <sys/mman.h>

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <memory>
#include <new>

namespace tactus::firmware {

namespace {

void write_header(std::FILE* file, std::size_t joints) {
  std::fputs(
      "tick,scheduled_ns,woke_ns,done_ns,sample_ns,mode,faults,limits,device_status,"
      "sample_age_us,contact,tool_x_m,tool_y_m,tool_z_m,proxy_x_m,proxy_y_m,proxy_z_m,"
      "force_x_N,force_y_N,force_z_N,state_hash",
      file);
  for (std::size_t i = 1; i <= joints; ++i) {
    std::fprintf(file, ",joint%zu,effort%zu,shaft%zu_rad,torque%zu_Nm", i, i, i, i);
  }
  std::fputc('\n', file);
}

void write_triple(std::FILE* file, const Triple& triple) {
  std::fprintf(file, ",%.9g,%.9g,%.9g", triple[0], triple[1], triple[2]);
}

void write_tick(std::FILE* file, const LoggedTick& tick, std::size_t joints) {
  const TelemetryRecord& record = tick.record;
  const std::string_view mode = mode_name(record.mode);
  std::fprintf(file, "%" PRIu64 ",%" PRId64 ",%" PRId64 ",%" PRId64 ",%" PRId64, record.tick,
               tick.scheduled_ns, tick.woke_ns, tick.done_ns, tick.sample_ns);
  std::fprintf(file, ",%.*s,%" PRIu64 ",%" PRIu64 ",%" PRIu32 ",%" PRIu32 ",%d",
               static_cast<int>(mode.size()), mode.data(), record.faults, record.limits,
               record.device_status, record.sample_age_us,
               record.contact == rendering::ContactKind::none ? 0 : 1);
  write_triple(file, record.tool_p_W);
  write_triple(file, record.proxy_W);
  write_triple(file, record.force_commanded_W);
  std::fprintf(file, ",%016" PRIx64, record.state_hash);
  for (std::size_t i = 0; i < joints; ++i) {
    std::fprintf(file, ",%.9g,%.9g,%.9g,%.9g", record.joint_position[i], record.joint_effort[i],
                 tick.shaft_rad[i], tick.torque_Nm[i]);
  }
  std::fputc('\n', file);
}

}  // namespace

RunLog::~RunLog() {
  if (!ticks_.empty()) {
    munmap(ticks_.data(), ticks_.size_bytes());
  }
}

bool RunLog::reserve(std::size_t ticks) {
  void* memory = mmap(nullptr, ticks * sizeof(LoggedTick), PROT_READ | PROT_WRITE,
                      MAP_PRIVATE | MAP_ANONYMOUS | MAP_POPULATE, -1, 0);
  if (memory == MAP_FAILED) {
    return false;
  }
  auto* first = static_cast<LoggedTick*>(memory);
  std::uninitialized_value_construct_n(first, ticks);
  ticks_ = {first, ticks};
  return true;
}

void RunLog::add(const LoggedTick& tick) {
  if (count_ == ticks_.size()) {
    ++left_out_;
    return;
  }
  ticks_[count_] = tick;
  ++count_;
}

int RunLog::write_csv(const char* path, std::size_t joints) const {
  std::FILE* file = std::fopen(path, "w");
  if (file == nullptr) {
    return errno;
  }
  write_header(file, joints);
  for (const LoggedTick& tick : ticks_.first(count_)) {
    write_tick(file, tick, joints);
  }
  const bool failed = std::ferror(file) != 0;
  return std::fclose(file) != 0 || failed ? EIO : 0;
}

}  // namespace tactus::firmware
