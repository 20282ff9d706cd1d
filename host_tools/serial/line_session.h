// A gateway in a thread of its own, with a private folder of sockets: the board of `--serial` for
// one verb.
#pragma once

#include <atomic>
#include <exception>
#include <filesystem>
#include <memory>
#include <thread>

#include "host_tools/files/private_folder.h"
#include "host_tools/remote/remote.h"
#include "host_tools/serial/line_gateway.h"

namespace tactus::host {

// The session of one verb. The thread that starts it also ends it.
class LineSession {
 public:
  // Opens the gateway. `options.run_dir` is replaced. Throws what LineGateway throws.
  explicit LineSession(GatewayOptions options);
  LineSession(const LineSession&) = delete;
  LineSession& operator=(const LineSession&) = delete;
  ~LineSession();

  // Returns the folder of the sockets.
  [[nodiscard]] const std::filesystem::path& folder() const { return folder_.path(); }
  // Returns true if the gateway has ended by itself. Any thread.
  [[nodiscard]] bool has_failed() const { return has_failed_.load(); }
  // Ends the gateway. Throws what ended it by itself.
  void finish();

 private:
  PrivateFolder folder_;
  std::atomic<bool> is_to_end_{false};
  std::atomic<bool> has_failed_{false};
  // It is written before has_failed_, and read after the thread's end.
  std::exception_ptr error_;
  std::unique_ptr<LineGateway> gateway_;
  std::jthread thread_;
};

// Sends the emergency stop to the board, as the first thing on the line, and again until the board
// has answered. Throws UnreachableError if the line cannot be opened or no answer comes within a
// second: the user must then cut the power of the motors.
Reply send_stop_over_line(const SerialPlace& place);

}  // namespace tactus::host
