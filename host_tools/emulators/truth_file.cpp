#include <fmt/format.h>

#include <iterator>
#include <string>

#include "host_tools/emulators/emulated_run.h"
#include "host_tools/simulation/run_log.h"

namespace tactus::host {
namespace {

// Returns the names of the columns for that many joints.
std::string truth_header(std::size_t joints) {
  std::string header = "t_ns";
  for (const char* const column :
       {"joint_{}", "joint_{}_velocity", "shaft_{}_torque_Nm", "fault_{}"}) {
    for (std::size_t i = 0; i < joints; ++i) {
      header += ',' + fmt::format(fmt::runtime(column), i);
    }
  }
  return header +
         ",handle_x_m,handle_y_m,handle_z_m,handle_vx_m_per_s,handle_vy_m_per_s,handle_vz_m_per_s,"
         "motor_force_x_N,motor_force_y_N,motor_force_z_N,"
         "hand_force_x_N,hand_force_y_N,hand_force_z_N\n";
}

// Appends three columns.
void append_vector(std::string& line, const Vec3& v) {
  fmt::format_to(std::back_inserter(line), ",{:.9g},{:.9g},{:.9g}", v.x(), v.y(), v.z());
}

}  // namespace

void write_truth(const std::filesystem::path& path, std::span<const MachineTruth> truth,
                 std::size_t joints) {
  LogFile file(path, truth_header(joints));
  for (const MachineTruth& sample : truth) {
    std::string& line = file.buffer();
    line += fmt::format("{}", sample.time_ns);
    for (const auto* const values :
         {&sample.joint_position, &sample.joint_velocity, &sample.shaft_torque_Nm}) {
      for (std::size_t i = 0; i < joints; ++i) {
        fmt::format_to(std::back_inserter(line), ",{:.12g}", (*values)[i]);
      }
    }
    for (std::size_t i = 0; i < joints; ++i) {
      fmt::format_to(std::back_inserter(line), ",{}", static_cast<int>(sample.fault[i]));
    }
    append_vector(line, sample.handle_p_B);
    append_vector(line, sample.handle_v_B);
    append_vector(line, sample.motor_force_B);
    append_vector(line, sample.hand_force_B);
    line += '\n';
    file.flush_if_full();
  }
  file.close();
}

}  // namespace tactus::host
