#include "firmware/linux/realtime/crash_stop.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <string_view>

#include "firmware/linux/realtime/helper_thread.h"

namespace tactus::firmware {
namespace {

using ::testing::KilledBySignal;

void tell(std::string_view words) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
}

void stop() {
  tell("motors stopped by the handler\n");
}

// Far longer than a stop may take.
void hang() {
  sleep(5);
}

// Acts like the loop: it notices the crash, stops the motors, and lets the crash go on.
void crash_beside_the_loop(int signal) {
  catch_crashes(stop);
  HelperThread helper;
  helper.start("crashing", [](void* crash) { raise(*static_cast<int*>(crash)); }, &signal);
  while (!has_helper_crashed()) {
    usleep(100);
  }
  tell("motors stopped by the loop\n");
  end_in_crash();
}

void crash_in_the_loop(void (*stop_motors)(), int signal) {
  catch_crashes(stop_motors);
  raise(signal);
}

// A stack that has run over has no room for a handler.
int run_over(int depth) {
  std::array<char, 1024> room;
  volatile char* const used = room.data();
  *used = static_cast<char>(depth);
  return depth < 0 ? *used : run_over(depth + 1) + *used;
}

TEST(CrashStop, InTheLoopStopsTheMotorsAndEndsWithTheSignal) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGILL, SIGFPE, SIGABRT}) {
    EXPECT_EXIT(crash_in_the_loop(stop, signal), KilledBySignal(signal), "by the handler");
  }
}

TEST(CrashStop, BesideTheLoopWaitsUntilTheLoopHasStoppedTheMotors) {
  for (const int signal : {SIGSEGV, SIGABRT}) {
    EXPECT_EXIT(crash_beside_the_loop(signal), KilledBySignal(signal),
                "^motors stopped by the loop");
  }
}

TEST(CrashStop, EndsTheProgramWhenStoppingHangs) {
  EXPECT_EXIT(crash_in_the_loop(hang, SIGSEGV), KilledBySignal(SIGALRM), "");
}

TEST(CrashStop, EndsTheProgramWhenStoppingCrashesToo) {
  EXPECT_EXIT(crash_in_the_loop([] { raise(SIGBUS); }, SIGSEGV), KilledBySignal(SIGBUS), "");
}

TEST(CrashStop, HasRoomForItselfWhenTheStackHasRunOver) {
  const auto overflow = [] {
    catch_crashes(stop);
    run_over(0);
  };
  EXPECT_EXIT(overflow(), KilledBySignal(SIGSEGV), "by the handler");
}

}  // namespace
}  // namespace tactus::firmware
