#include "tests/unit/firmware/linux/tactusd/tactusd_bench.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <string_view>

#include "host_tools/remote/remote.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::testing {
namespace {

namespace fs = std::filesystem;

constexpr double kPatience_s = 4.0;
constexpr int kTries = 10;

// A wall above the tool's home; the hand pushes 5 mm into it.
constexpr std::string_view kScene = R"([tool]
radius_m = 0.002
[[object]]
name = "wall"
primitive = "box"
size_m = [0.2, 0.2, 0.1]
position_m = [0.0, 0.0, 0.055]
stiffness_N_per_m = 150.0
)";

std::string device_text(const std::string& port) {
  // Slow ticks, of which a busy machine may be late for any.
  return "name = \"Haply\"\n[mechanism]\nkind = \"haply_pantograph\"\n[controller]\nrate_hz = "
         "200\nmax_sample_age_us = 200000\nmax_tick_gap_s = 1\nlate_ticks_to_fault = 1000\n"
         "[[connection]]\nname = \"usb\"\nkind = \"haply_serial\"\nport = \"" +
         port +
         "\"\nunproven_watchdog = true\n[[axis]]\nname = \"m1\"\ndriver = "
         "\"haply_serial\"\nconnection = \"usb\"\nnumber = "
         "0\n"
         "[[axis]]\nname = \"m2\"\ndriver = \"haply_serial\"\nconnection = \"usb\"\nnumber = 1\n"
         "[[joint]]\nname = \"left\"\nmotor = \"m1\"\nreference = \"known_pose\"\nreference_rad = "
         "2.55406\n[[joint]]\nname = \"right\"\nmotor = "
         "\"m2\"\nreference = \"known_pose\"\nreference_rad = 0\n";
}

// Returns the name of a device's files without their ending.
std::string device_name(std::size_t number) {
  return number == 0 ? "device" : "device" + std::to_string(number + 1);
}

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    text += line + '\n';
  }
  return text;
}

void bake(const fs::path& folder, const std::string& file) {
  const auto baked = run_program(folder, "bake --quiet " + file);
  EXPECT_EQ(baked.exit_code, 0) << baked.output;
}

}  // namespace

TactusdBench::TactusdBench(std::size_t boards) {
  std::string pattern = (fs::temp_directory_path() / "tactusd-XXXXXX").string();
  EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
  for (std::size_t i = 0; i < boards; ++i) {
    boards_.push_back(std::make_unique<KeepingBoard>());
    const std::string file = device_name(i) + ".toml";
    std::ofstream(folder_ / file) << device_text(boards_.back()->port());
    bake(folder_, file);
  }
  std::ofstream(folder_ / "scene.toml") << kScene;
  bake(folder_, "scene.toml");
}

TactusdBench::~TactusdBench() {
  for (const pid_t process : started_) {
    // One that a test has waited for is nobody's child any more.
    if (::waitpid(process, nullptr, WNOHANG) == 0) {
      ::kill(process, SIGKILL);
      ::waitpid(process, nullptr, 0);
    }
  }
  fs::remove_all(folder_);
}

pid_t TactusdBench::start(const std::string& log, const fs::path& run_dir,
                          const std::vector<std::string>& options) const {
  std::vector<std::string> words{"tactusd"};
  for (std::size_t i = 0; i < boards_.size(); ++i) {
    words.push_back(device_name(i) + ".tactus");
  }
  words.insert(words.end(), {"scene.tactus", "--enable", "--allow-uncommissioned",
                             "--allow-non-realtime", "--run-dir", run_dir.string()});
  words.insert(words.end(), options.begin(), options.end());
  std::vector<char*> arguments;
  arguments.reserve(words.size() + 1);
  std::ranges::transform(words, std::back_inserter(arguments),
                         [](std::string& word) { return word.data(); });
  arguments.push_back(nullptr);
  const std::string file = (folder_ / log).string();
  const std::string program = built_program("tactusd");
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();
    const int out = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
    ::dup2(out, STDERR_FILENO);
    if (::chdir(folder_.c_str()) == 0) {
      ::execv(program.c_str(), arguments.data());
    }
    ::_exit(127);
  }
  started_.push_back(child);
  return child;
}

bool TactusdBench::all_push_within(double seconds) const {
  return std::ranges::all_of(
      boards_, [seconds](const auto& board) { return board->pushes_within(seconds); });
}

double TactusdBench::torque_Nm() const {
  double largest = 0.0;
  for (const auto& board : boards_) {
    largest = std::max(largest, board->torque_Nm());
  }
  return largest;
}

std::string TactusdBench::log(const std::string& name) const {
  std::string status;
  try {
    status = host::Remote(folder_).send("status").text;
  } catch (const host::UnreachableError& error) {
    status = error.what();
  }
  return text_of(folder_ / name) + status;
}

Pushing start_pushing(std::size_t boards, const std::vector<std::string>& options) {
  Pushing pushing;
  for (int i = 0; i < kTries; ++i) {
    pushing.bench = std::make_unique<TactusdBench>(boards);
    pushing.process = pushing.bench->start(options);
    if (pushing.bench->all_push_within(kPatience_s)) {
      return pushing;
    }
  }
  ADD_FAILURE() << "no torque: " << pushing.bench->log();
  return pushing;
}

int wait_for_end(pid_t process) {
  int status = 0;
  for (int i = 0; i < 1000; ++i) {
    if (::waitpid(process, &status, WNOHANG) == process) {
      return status;
    }
    ::usleep(10'000);
  }
  ::kill(process, SIGKILL);
  ::waitpid(process, &status, 0);
  return -1;
}

}  // namespace tactus::testing
