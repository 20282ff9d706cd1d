// The program tactusd itself before a board that keeps its torque.
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "firmware/linux/realtime/end_signals.h"
#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"
#include "tests/unit/firmware/linux/tactusd/tactusd_bench.h"

namespace tactus::firmware {
namespace {

namespace fs = std::filesystem;
using testing::start_pushing;
using testing::TactusdBench;
using testing::wait_for_end;

struct AfterSignal {
  double before_Nm = 0.0;
  int status = -1;
  double torque_Nm = -1.0;
};

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
  const TactusdBench& bench = *held;
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
  const TactusdBench& bench = *held;
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
  const TactusdBench bench;
  const int status = wait_for_end(bench.start("log", bench.folder() / "none"));
  EXPECT_EQ(WEXITSTATUS(status), 2);
  EXPECT_NE(bench.log().find("no such folder"), std::string::npos) << bench.log();
}

TEST(TactusdRecording, ThatIsThereIsKeptUnlessItMayBeOverwritten) {
  const TactusdBench bench;
  const std::string file = bench.folder() / "run.mcap";
  std::ofstream(file) << "mine";
  EXPECT_EQ(WEXITSTATUS(wait_for_end(bench.start({"--record", file}))), 2);
  EXPECT_NE(bench.log().find("is there and is kept; name another, or say --overwrite"),
            std::string::npos)
      << bench.log();
  EXPECT_EQ(fs::file_size(file), 4U);
  (void)wait_for_end(bench.start({"--record", file, "--overwrite", "--seconds", "0.2"}));
  EXPECT_GT(fs::file_size(file), 4U) << bench.log();

  EXPECT_EQ(WEXITSTATUS(wait_for_end(bench.start({"--record", "run.txt"}))), 2);
  EXPECT_NE(bench.log().find("give a file that ends in .mcap or .csv after --record"),
            std::string::npos)
      << bench.log();
}

// Each in place: the file keeps its inode, as with cp or an editor.
TEST(TactusdImages, LiveOnWhateverHappensToTheirFiles) {
  const auto [held, process] = start_pushing();
  const TactusdBench& bench = *held;
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
  const TactusdBench& bench = *held;
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
