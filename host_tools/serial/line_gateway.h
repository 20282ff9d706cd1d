// Serves a board at the other end of a line as tactusd serves its device: with the live socket, the
// command socket and the stop socket in a folder, and with recordings. So every program that knows
// these sockets works with a board.
//
// One thread constructs the gateway and runs it; the sockets have threads of their own. Names of
// objects and parameters are resolved here, by the board's scene; numbers go over the line.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "firmware/commands/command_queue.h"
#include "firmware/line/message.h"
#include "firmware/linux/commands/command_server.h"
#include "firmware/linux/commands/scene_store.h"
#include "hal/linux/mapped_file.h"
#include "host_tools/serial/board_images.h"
#include "host_tools/serial/board_link.h"
#include "host_tools/serial/line_telemetry.h"
#include "host_tools/serial/relay.h"

namespace tactus::host {

// The settings of a gateway.
struct GatewayOptions {
  SerialPlace place;
  // The folder of the sockets, which is made if it is not there.
  std::filesystem::path run_dir;
  // The recording, .mcap or .csv; empty: none but those that the command socket starts.
  std::string record;
  // The user's files of the board's images; empty: they come from the cache, or over the line.
  std::string device_image;
  std::string scene_image;
  // True if ticks are wanted: for the live socket and for recordings.
  bool wants_ticks = true;
  // One tick of so many; 0: every one, or as many as the line can carry.
  std::uint32_t every = 0;
  // The time that the first answer of a board may take, s: longer to wait for its start.
  double patience_s = 3.0;
  // True if names of objects are resolved, or if recordings are to be replayed.
  bool wants_images = true;
  // Gets the board's lines of text.
  std::function<void(std::string_view)> text;
  // Gets the progress of an image that comes over the line.
  ShowProgress progress;
};

// The gateway. Its functions throw UnreachableError if the board does not answer, has restarted, or
// the line is lost, and InputError if a file, folder or socket cannot be used.
class LineGateway {
 public:
  // Asks the board what it is, gets its images and opens the sockets.
  explicit LineGateway(GatewayOptions options);
  LineGateway(const LineGateway&) = delete;
  LineGateway& operator=(const LineGateway&) = delete;
  // Closes the sockets.
  ~LineGateway();

  // Serves until `is_to_end` is true. Then it ends the supervision of the board in an orderly
  // manner, and completes the recording.
  void run(const std::atomic<bool>& is_to_end);

  // Returns what the board said of itself.
  [[nodiscard]] const firmware::Hello& board() const { return board_; }
  // Returns how many ticks lie between two that the board sends; 0: it sends none.
  [[nodiscard]] std::uint32_t every() const { return every_; }
  // Returns how many ticks have not come between the first and the last one. The thread of run()
  // alone.
  [[nodiscard]] std::uint64_t missing_ticks() const;
  // Returns the ticks that have come. The thread of run() alone.
  [[nodiscard]] const LineTelemetry& telemetry() const { return telemetry_; }

 private:
  // Steps of the start.
  void ask_for_board();
  void choose_ticks();
  void get_images();
  std::filesystem::path file_of(firmware::BoardImage image, const std::string& given,
                                const firmware::ImageOnBoard& wanted);
  void open_sockets();

  // Takes a message of the board.
  void hear(std::span<const std::byte> message);
  // Ends the run if the board has started anew.
  void check_hello(const firmware::Hello& hello);
  // One turn of run().
  void turn();
  // Tells the board that somebody is there, and asks it for a sign of life.
  void keep_alive(hal::TimeNs now_ns);
  // Completes the recording after the last tick.
  void finish();
  [[noreturn]] void lost(std::string_view why) const;

  GatewayOptions options_;
  BoardLink link_;
  firmware::Hello board_;
  bool has_board_ = false;
  std::optional<std::uint8_t> other_version_;
  std::uint32_t every_ = 0;
  hal::TimeNs alive_ns_ = 0;
  hal::TimeNs asked_ns_ = 0;
  hal::MappedFile device_;
  // Each has megabytes, too many for the stack. Members are destroyed in reverse order: the server
  // goes before what it serves.
  std::unique_ptr<firmware::SceneStore> scenes_ = std::make_unique<firmware::SceneStore>();
  LineTelemetry telemetry_;
  std::unique_ptr<firmware::CommandQueue> queue_ = std::make_unique<firmware::CommandQueue>();
  std::optional<Relay> relay_;
  std::unique_ptr<firmware::CommandServer> server_;
};

// Returns one of how many ticks a place can carry at the rate of the board.
std::uint32_t ticks_apart(const SerialPlace& place, double rate_hz);

}  // namespace tactus::host
