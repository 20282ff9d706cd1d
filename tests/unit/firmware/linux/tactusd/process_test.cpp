// The program tactusd itself before a board that keeps its torque.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/linux/realtime/end_signals.h"
#include "hal/linux/system.h"
#include "host_tools/remote/remote.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/unit/firmware/linux/tactusd/keeping_board.h"

namespace tactus::firmware {
namespace {

namespace fs = std::filesystem;
using testing::KeepingBoard;

constexpr double kPatience_s = 4.0;
// A busy machine keeps a board from answering in time, which is a fault before there is torque.
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
  // Slow ticks: a busy machine is late for none.
  return "name = \"Haply\"\n[mechanism]\nkind = \"haply_pantograph\"\n[controller]\nrate_hz = "
         "200\nmax_sample_age_us = 200000\n"
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

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::string text;
  for (std::string line; std::getline(file, line);) {
    text += line + '\n';
  }
  return text;
}

// A folder with a board, images and what tactusd says.
class Bench {
 public:
  Bench() {
    std::string pattern = (fs::temp_directory_path() / "tactusd-XXXXXX").string();
    EXPECT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    std::ofstream(folder_ / "device.toml") << device_text(board_.port());
    std::ofstream(folder_ / "scene.toml") << kScene;
    const auto device = testing::run_program(folder_, "bake --quiet device.toml");
    EXPECT_EQ(device.exit_code, 0) << device.output;
    const auto scene = testing::run_program(folder_, "bake --quiet scene.toml");
    EXPECT_EQ(scene.exit_code, 0) << scene.output;
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;
  ~Bench() {
    for (const pid_t process : started_) {
      // One that a test has waited for is nobody's child any more.
      if (::waitpid(process, nullptr, WNOHANG) == 0) {
        ::kill(process, SIGKILL);
        ::waitpid(process, nullptr, 0);
      }
    }
    fs::remove_all(folder_);
  }

  // The program's process; it has its own session, so that no terminal and no group is disturbed.
  [[nodiscard]] pid_t start(const std::string& log, const fs::path& run_dir) const {
    const std::string file = (folder_ / log).string();
    const std::string folder = run_dir.string();
    const std::string program = testing::built_program("tactusd");
    const pid_t child = ::fork();
    if (child == 0) {
      ::setsid();
      const int out = ::open(file.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0600);
      ::dup2(out, STDERR_FILENO);
      if (::chdir(folder_.c_str()) == 0) {
        ::execl(program.c_str(), "tactusd", "device.tactus", "scene.tactus", "--enable",
                "--allow-uncommissioned", "--allow-non-realtime", "--run-dir", folder.c_str(),
                nullptr);
      }
      ::_exit(127);
    }
    started_.push_back(child);
    return child;
  }
  [[nodiscard]] pid_t start() const { return start("log", folder_); }

  [[nodiscard]] const fs::path& folder() const { return folder_; }
  [[nodiscard]] const KeepingBoard& board() const { return board_; }
  [[nodiscard]] std::string log(const std::string& name = "log") const {
    std::string status;
    try {
      status = host::Remote(folder_).send("status").text;
    } catch (const host::UnreachableError& error) {
      status = error.what();
    }
    return text_of(folder_ / name) + status;
  }

 private:
  KeepingBoard board_;
  fs::path folder_;
  mutable std::vector<pid_t> started_;
};

// The status of waitpid, or -1 after the time: then it is killed.
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

struct AfterSignal {
  double before_Nm = 0.0;
  int status = -1;
  double torque_Nm = -1.0;
};

// A bench whose board pushes, with the program's process.
struct Pushing {
  std::unique_ptr<Bench> bench;
  pid_t process = 0;
};

Pushing start_pushing() {
  Pushing pushing;
  for (int i = 0; i < kTries; ++i) {
    pushing.bench = std::make_unique<Bench>();
    pushing.process = pushing.bench->start();
    if (pushing.bench->board().pushes_within(kPatience_s)) {
      return pushing;
    }
  }
  ADD_FAILURE() << "no torque: " << pushing.bench->log();
  return pushing;
}

AfterSignal send_while_pushing(int signal) {
  const auto [bench, process] = start_pushing();
  AfterSignal after{.before_Nm = bench->board().torque_Nm()};
  ::kill(process, signal);
  after.status = wait_for_end(process);
  ::usleep(50'000);  // what is on the line arrives
  after.torque_Nm = bench->board().torque_Nm();
  return after;
}

std::vector<int> signals_that(SignalReaction reaction) {
  std::vector<int> signals;
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    // Real-time signals are alike: the first, one between and the last. EndSignals goes over all.
    const bool is_between = signal > SIGRTMIN + 1 && signal < SIGRTMAX;
    if (reaction_to(signal) == reaction && !is_between) {
      signals.push_back(signal);
    }
  }
  return signals;
}

// Two at a time: each waits for its board most of the time.
template <class Each>
void for_each_signal(const std::vector<int>& signals, Each each) {
  std::atomic<std::size_t> next{0};
  std::vector<std::thread> threads;
  threads.reserve(2);
  for (int i = 0; i < 2; ++i) {
    threads.emplace_back([&] {
      for (std::size_t k = next++; k < signals.size(); k = next++) {
        each(signals[k]);
      }
    });
  }
  for (std::thread& thread : threads) {
    thread.join();
  }
}

TEST(TactusdSignals, NoneThatEndsOrStopsTheProgramLeavesTorqueOnTheBoard) {
  std::mutex printing;
  for_each_signal(signals_that(SignalReaction::end), [&](int signal) {
    const AfterSignal after = send_while_pushing(signal);
    const std::scoped_lock lock(printing);
    std::printf("signal %2d (%s): torque %.4f N m before, %.4f N m left\n", signal,
                ::strsignal(signal), after.before_Nm, after.torque_Nm);
    EXPECT_TRUE(WIFEXITED(after.status) && WEXITSTATUS(after.status) == 0) << after.status;
    EXPECT_EQ(after.torque_Nm, 0.0) << signal;
  });
}

TEST(TactusdSignals, ACrashLeavesNoTorqueAndKeepsItsSignal) {
  std::mutex printing;
  for_each_signal(signals_that(SignalReaction::crash), [&](int signal) {
    const AfterSignal after = send_while_pushing(signal);
    const std::scoped_lock lock(printing);
    std::printf("signal %2d (%s): torque %.4f N m before, %.4f N m left\n", signal,
                ::strsignal(signal), after.before_Nm, after.torque_Nm);
    EXPECT_TRUE(WIFSIGNALED(after.status) && WTERMSIG(after.status) == signal) << after.status;
    EXPECT_EQ(after.torque_Nm, 0.0) << signal;
  });
}

TEST(TactusdSignals, TheOthersLeaveItAtWork) {
  const auto [held, process] = start_pushing();
  const Bench& bench = *held;
  for (const SignalReaction reaction :
       {SignalReaction::ignore, SignalReaction::harmless, SignalReaction::flight}) {
    for (const int signal : signals_that(reaction)) {
      ::kill(process, signal);
    }
  }
  ::usleep(200'000);
  EXPECT_EQ(host::field_of(host::Remote(bench.folder()).send("status").text, "mode"), "active")
      << bench.log();
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for_end(process), 0);
  EXPECT_EQ(bench.board().torque_Nm(), 0.0);
}

TEST(TactusdSecond, DoesNotStartOnTheSameRunFolderOrTheSamePort) {
  const auto [held, first] = start_pushing();
  const Bench& bench = *held;
  const std::string holder = "process " + std::to_string(first);

  const int same_folder = wait_for_end(bench.start("second", bench.folder()));
  EXPECT_EQ(WEXITSTATUS(same_folder), 2);
  EXPECT_NE(bench.log("second").find("the run folder"), std::string::npos) << bench.log("second");
  EXPECT_NE(bench.log("second").find(holder), std::string::npos) << bench.log("second");

  const fs::path other = bench.folder() / "other";
  fs::create_directory(other);
  const int same_port = wait_for_end(bench.start("third", other));
  EXPECT_EQ(WEXITSTATUS(same_port), 2);
  EXPECT_NE(bench.log("third").find("the serial port"), std::string::npos) << bench.log("third");
  EXPECT_NE(bench.log("third").find(holder), std::string::npos) << bench.log("third");

  EXPECT_TRUE(host::send_stop(bench.folder()).is_ok);
  ::kill(first, SIGTERM);
  EXPECT_GE(wait_for_end(first), 0);
  EXPECT_EQ(bench.board().torque_Nm(), 0.0);
}

TEST(TactusdSecond, DoesNotStartWithoutAFolderForItsStop) {
  const Bench bench;
  const int status = wait_for_end(bench.start("log", bench.folder() / "none"));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(bench.log().find("no such folder"), std::string::npos) << bench.log();
}

// Each in place: the file keeps its inode, as with cp or an editor.
TEST(TactusdImages, LiveOnWhateverHappensToTheirFiles) {
  const auto [held, process] = start_pushing();
  const Bench& bench = *held;
  for (const char* name : {"scene.tactus", "device.tactus"}) {
    const fs::path path = bench.folder() / name;
    {
      std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
      for (std::uintmax_t i = 0, size = fs::file_size(path); i < size; ++i) {
        file.put('\xff');
      }
    }
    ASSERT_EQ(::truncate(path.c_str(), 0), 0);
  }
  ::usleep(300'000);
  EXPECT_GT(bench.board().torque_Nm(), 0.0);
  EXPECT_EQ(host::field_of(host::Remote(bench.folder()).send("status").text, "mode"), "active")
      << bench.log();
  ::kill(process, SIGTERM);
  EXPECT_EQ(wait_for_end(process), 0) << bench.log();
}

TEST(TactusdImages, FromAPipeOrTooLargeAreRefusedAtOnceAndTheStopIsHeard) {
  const auto [held, process] = start_pushing();
  const Bench& bench = *held;
  host::Remote remote(bench.folder());
  EXPECT_TRUE(host::send_stop(bench.folder()).is_ok);
  ASSERT_EQ(::mkfifo((bench.folder() / "pipe").c_str(), 0600), 0);
  std::ofstream(bench.folder() / "sparse") << "x";
  ASSERT_EQ(::truncate((bench.folder() / "sparse").c_str(), off_t{2} << 30), 0);
  const std::string pipe = remote.send("scene " + (bench.folder() / "pipe").string()).text;
  EXPECT_NE(pipe.find("not a regular file"), std::string::npos) << pipe;
  const std::string sparse = remote.send("scene " + (bench.folder() / "sparse").string()).text;
  EXPECT_NE(sparse.find("--scene-memory"), std::string::npos) << sparse;
  EXPECT_TRUE(host::send_stop(bench.folder()).is_ok);
  ::kill(process, SIGTERM);
  EXPECT_GE(wait_for_end(process), 0);
}

}  // namespace
}  // namespace tactus::firmware
