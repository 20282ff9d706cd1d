#include "firmware/linux/realtime/end_signals.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <string_view>

#include "firmware/linux/realtime/crash_stop.h"
#include "firmware/linux/realtime/helper_thread.h"

namespace tactus::firmware {
namespace {

constexpr int kEndedByLoop = 7;

std::atomic<bool> asked_to_end{false};
std::atomic<bool> asked_for_flight{false};

void write_words(std::string_view words) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, words.data(), words.size());
}

void begin_program() {
  catch_end_signals([](int) { asked_to_end = true; }, [](int) { asked_for_flight = true; });
  catch_crashes([] { write_words("motors without torque\n"); });
}

// A loop as tactusd's, beside a thread as tactusd has them: it ends when it is asked, motors first.
[[noreturn]] void loop_until_asked(int ticks) {
  for (int tick = 0; tick < ticks && !asked_to_end; ++tick) {
    usleep(1000);
  }
  write_words(asked_to_end ? "motors without torque\n" : "goes on\n");
  _exit(asked_to_end ? kEndedByLoop : 0);
}

void meet_signal(int signal) {
  begin_program();
  HelperThread beside;
  beside.start("beside", [](void*) { pause(); }, nullptr);
  kill(getpid(), signal);
  loop_until_asked(reaction_to(signal) == SignalReaction::end ? 5000 : 20);
}

// An emulator keeps some real-time signals for itself: nobody can send them there.
bool can_be_sent(int signal) {
  sigset_t one;
  sigset_t before;
  sigemptyset(&one);
  sigaddset(&one, signal);
  pthread_sigmask(SIG_BLOCK, &one, &before);
  const bool is_sent = kill(getpid(), signal) == 0;
  if (is_sent) {
    const timespec at_once{};
    sigtimedwait(&one, nullptr, &at_once);
  }
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return is_sent;
}

TEST(EndSignals, EachOneThatWouldEndOrStopTheProgramTakesTheTorqueAwayFirst) {
  int ends = 0;
  int unsent = 0;
  for (int signal = 1; signal <= SIGRTMAX; ++signal) {
    SCOPED_TRACE(signal);
    if (signal >= SIGRTMIN && !can_be_sent(signal)) {
      std::printf("signal %d cannot be sent here\n", signal);
      ++unsent;
      continue;
    }
    switch (reaction_to(signal)) {
      case SignalReaction::end:
        EXPECT_EXIT(meet_signal(signal), ::testing::ExitedWithCode(kEndedByLoop),
                    "motors without torque");
        ++ends;
        break;
      case SignalReaction::crash:
        EXPECT_EXIT(meet_signal(signal), ::testing::KilledBySignal(signal),
                    "motors without torque");
        break;
      case SignalReaction::flight:
      case SignalReaction::ignore:
      case SignalReaction::harmless:
        EXPECT_EXIT(meet_signal(signal), ::testing::ExitedWithCode(0), "goes on");
        break;
      case SignalReaction::uncaught:
        EXPECT_TRUE(signal == SIGKILL || signal == SIGSTOP);
        break;
    }
  }
  // Hang-up, interrupt, quit, user 2, alarm, termination, stack fault, three of terminals, two of
  // limits, two of timers, I/O, power, and all real-time signals.
  EXPECT_EQ(ends + unsent, 16 + SIGRTMAX - SIGRTMIN + 1);
  EXPECT_LE(unsent, 2);
}

TEST(EndSignals, OneThatWasBlockedByWhoeverStartedTheProgramIsHeard) {
  const auto blocked = [] {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_BLOCK, &all, nullptr);
    begin_program();
    kill(getpid(), SIGHUP);
    loop_until_asked(5000);
  };
  EXPECT_EXIT(blocked(), ::testing::ExitedWithCode(kEndedByLoop), "motors without torque");
}

TEST(EndSignals, AWriteToAPipeThatNobodyReadsFailsAndEndsNothing) {
  const auto write_to_nobody = [] {
    begin_program();
    std::array<int, 2> ends{};
    if (pipe(ends.data()) == 0) {
      close(ends[0]);
      write_words(write(ends[1], "x", 1) < 0 && errno == EPIPE ? "refused\n" : "written\n");
    }
    loop_until_asked(5);
  };
  EXPECT_EXIT(write_to_nobody(), ::testing::ExitedWithCode(0), "refused\ngoes on");
}

TEST(EndSignals, AFlightIsAskedForAndNothingEnds) {
  const auto ask = [] {
    begin_program();
    kill(getpid(), SIGUSR1);
    write_words(asked_for_flight ? "flight\n" : "none\n");
    loop_until_asked(5);
  };
  EXPECT_EXIT(ask(), ::testing::ExitedWithCode(0), "flight\ngoes on");
}

TEST(EndSignals, ASecondOneEndsAProgramThatIsSlowToEnd) {
  const auto slow = [] {
    begin_program();
    kill(getpid(), SIGTERM);
    release_end_signals();
    kill(getpid(), SIGTERM);
    loop_until_asked(5000);
  };
  EXPECT_EXIT(slow(), ::testing::KilledBySignal(SIGTERM), "");
}

}  // namespace
}  // namespace tactus::firmware
