#include "host_tools/monitor/session.h"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "host_tools/input_error.h"
#include "host_tools/monitor/run_view.h"
#include "host_tools/monitor/screen.h"
#include "host_tools/monitor/terminal.h"
#include "host_tools/recording/live_reader.h"
#include "host_tools/remote/remote.h"

namespace tactus::host {

namespace {

using std::chrono::steady_clock;
using namespace std::chrono_literals;

// Ten pictures a second are enough for an eye, and little for ssh.
constexpr auto kRedraw = 100ms;
// The time between two attempts to reach a controller that has gone.
constexpr auto kTryAgain = 1000ms;
// The controller answers within one second.
constexpr auto kPatience = 1500ms;

// Written by a signal, read by the loop.
volatile std::sig_atomic_t asked_to_end = 0;

void on_end(int /*signal*/) {
  asked_to_end = 1;
}

// Returns the command of a key; nullptr for a key without one.
const char* command_of(int key) {
  switch (key) {
    case 'h':
      return "home";
    case 'e':
      return "enable";
    case 'd':
      return "disable";
    case 'r':
      return "reset";
    case ' ':
      return "estop";
    default:
      return nullptr;
  }
}

// One use of the monitor.
class Session {
 public:
  explicit Session(const std::filesystem::path& run_dir)
      : run_dir_(run_dir), socket_((run_dir / kLiveSocketFile).string()) {
    reader_.emplace(socket_);
  }

  void run(const std::function<bool()>& is_over) {
    Terminal terminal;
    auto next_picture = steady_clock::now();
    while (asked_to_end == 0 && !is_over()) {
      wait(next_picture);
      take_messages();
      if (!take_keys(terminal)) {
        return;
      }
      if (steady_clock::now() >= next_picture) {
        terminal.show(draw_screen(view_));
        next_picture = steady_clock::now() + kRedraw;
      }
    }
  }

 private:
  void wait(steady_clock::time_point until) const {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(until - steady_clock::now());
    std::array<pollfd, 2> files{
        {{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0},
         {.fd = reader_ ? reader_->descriptor() : -1, .events = POLLIN, .revents = 0}}};
    ::poll(files.data(), files.size(), static_cast<int>(std::max(left, 1ms).count()));
  }

  void take_messages() {
    if (!reader_ && steady_clock::now() >= try_again_) {
      try {
        reader_.emplace(socket_);
        explain(is_explaining_);
      } catch (const InputError&) {
        try_again_ = steady_clock::now() + kTryAgain;  // still nobody there
      }
    }
    while (reader_) {
      const auto message = reader_->next(0ms);
      if (!message) {
        break;
      }
      if (const auto* info = std::get_if<RunInfo>(&*message)) {
        view_.take(*info);
      } else if (const auto* tick = std::get_if<firmware::RecordedTick>(&*message)) {
        view_.take(*tick);
      } else if (const auto* told = std::get_if<firmware::Explanation>(&*message);
                 told != nullptr && is_explaining_) {
        view_.explain(*told);
      }
    }
    if (reader_ && reader_->ended()) {
      reader_.reset();
      view_.lose();
      try_again_ = steady_clock::now() + kTryAgain;
    }
  }

  // Sends the commands of the keys that were pressed. Returns false if the user wants to leave.
  bool take_keys(Terminal& terminal) {
    for (int key = terminal.key(); key != 0; key = terminal.key()) {
      if (key == 'q' || key == 'Q') {
        return false;
      }
      if (key == 'x') {
        explain(!is_explaining_);
      }
      if (const char* command = command_of(key)) {
        view_.say(ask(command));
      }
    }
    return true;
  }

  // Begins to show explanations, or ends it.
  void explain(bool on) {
    is_explaining_ = on;
    if (!on) {
      view_.explain(std::nullopt);
    }
    if (reader_) {
      reader_->ask_for_explanations(on);
    }
  }

  // Sends a command and returns the reply, or why there is none.
  [[nodiscard]] std::string ask(const char* command) const {
    try {
      return std::string_view(command) == "estop" ? send_stop(run_dir_, kPatience).text
                                                  : Remote(run_dir_).send(command, kPatience).text;
    } catch (const UnreachableError& error) {
      return error.what();
    }
  }

  std::filesystem::path run_dir_;
  std::string socket_;
  std::optional<LiveReader> reader_;
  steady_clock::time_point try_again_;
  RunView view_;
  bool is_explaining_ = false;
};

}  // namespace

void run_monitor(const std::filesystem::path& run_dir, const std::function<bool()>& is_over) {
  struct sigaction action{};
  action.sa_handler = on_end;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ::sigaction(SIGHUP, &action, nullptr);
  Session(run_dir).run(is_over);
}

}  // namespace tactus::host
