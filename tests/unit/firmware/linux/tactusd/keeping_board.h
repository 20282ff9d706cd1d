// A Haply board behind a pseudo-terminal that keeps its last torque, as the firmware does: nothing
// but a word from the host ends it. Its arms stand at home; the hand pushes them into the scene.
#pragma once

#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <string>
#include <thread>
#include <vector>

#include "hal/linux/system.h"

namespace tactus::testing {

class KeepingBoard {
 public:
  KeepingBoard();
  KeepingBoard(const KeepingBoard&) = delete;
  KeepingBoard& operator=(const KeepingBoard&) = delete;
  ~KeepingBoard();

  // The host's end.
  [[nodiscard]] const std::string& port() const { return port_; }
  // Returns the larger of the two motors' torques, N m.
  [[nodiscard]] double torque_Nm() const { return torque_Nm_; }
  // Returns true if the board gives the torque within the time.
  [[nodiscard]] bool pushes_within(double seconds) const;

 private:
  void run();
  void take();
  void answer();
  [[nodiscard]] double pushed() const;

  hal::FileDescriptor board_end_;
  hal::FileDescriptor host_end_;  // held open: a pseudo-terminal is hung up with its last host
  std::string port_;
  std::vector<unsigned char> arrived_;
  hal::TimeNs first_command_ns_ = 0;
  double pushed_at_setup_ = 0.0;
  std::array<float, 2> offset_deg_{};
  std::atomic<double> torque_Nm_{0.0};
  std::atomic<bool> ending_{false};
  std::thread thread_;
};

}  // namespace tactus::testing
