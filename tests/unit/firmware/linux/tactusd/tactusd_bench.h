// A folder with boards on pseudo-terminals, baked images, and the program tactusd before them.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "tests/unit/firmware/linux/tactusd/keeping_board.h"

namespace tactus::testing {

class TactusdBench {
 public:
  // Makes so many boards, and bakes the image of a device for each, device.tactus, device2.tactus
  // and so on, and a scene into which the hand pushes each of them.
  explicit TactusdBench(std::size_t boards = 1);
  TactusdBench(const TactusdBench&) = delete;
  TactusdBench& operator=(const TactusdBench&) = delete;
  ~TactusdBench();

  // Starts the program on all devices with --enable. It writes its messages to the file `log` of
  // the folder. It has a session of its own, so that no terminal and no group is disturbed.
  [[nodiscard]] pid_t start(const std::string& log, const std::filesystem::path& run_dir,
                            const std::vector<std::string>& options = {}) const;
  [[nodiscard]] pid_t start(const std::vector<std::string>& options = {}) const {
    return start("log", folder_, options);
  }

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  [[nodiscard]] const KeepingBoard& board(std::size_t number = 0) const { return *boards_[number]; }
  // Returns true if all boards give a torque within the time.
  [[nodiscard]] bool all_push_within(double seconds) const;
  // Returns the largest torque of any board, N m.
  [[nodiscard]] double torque_Nm() const;
  // Returns what the program has said, and its status.
  [[nodiscard]] std::string log(const std::string& name = "log") const;

 private:
  std::vector<std::unique_ptr<KeepingBoard>> boards_;
  std::filesystem::path folder_;
  mutable std::vector<pid_t> started_;
};

// A bench whose boards push, with the program's process.
struct Pushing {
  std::unique_ptr<TactusdBench> bench;
  pid_t process = 0;
};

// Starts the program anew until all boards push: a busy machine keeps a board from answering in
// time, which is a fault before there is torque.
Pushing start_pushing(std::size_t boards = 1, const std::vector<std::string>& options = {});

// Returns the status of waitpid, or -1 after ten seconds: then the process is killed.
int wait_for_end(pid_t process);

}  // namespace tactus::testing
