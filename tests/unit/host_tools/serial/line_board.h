// A board at the other end of a pseudo-terminal: the portable controller of a bare board with its
// simulated handle, in a thread.
//
// It fakes the following. Its ticks are as fast as this machine makes them, with a short sleep. The
// first tick waits for the first message that asks for ticks, so that a recording can begin with
// it. It has no ring of fixed size: a frame waits until the line takes it. It takes no motors'
// power away: it notes that it would have.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "firmware/bare_metal/held_handle.h"
#include "firmware/bare_metal/loaded_controller.h"
#include "firmware/commands/command_queue.h"
#include "firmware/line/frame.h"
#include "firmware/line/message.h"
#include "tests/unit/host_tools/serial/pseudo_terminal.h"

namespace tactus::host {

// The device and the scene of the board.
struct LineBoardImages {
  std::vector<std::byte> device;
  std::vector<std::byte> scene;
};

// Bakes the device of firmware/mps2_an500, and a scene with a ball named "ball".
LineBoardImages bake_line_images();

// Troubles that a test can make at any time.
struct LineTroubles {
  // Every so many frames of the board are broken; 0: none.
  std::atomic<std::uint32_t> broken_every{0};
  // The board stays silent.
  std::atomic<bool> is_mute{false};
  // The board answers no stop as long as this is above 0; each one counts down.
  std::atomic<int> unheard_stops{0};
  // The version of the messages that the board says that it has.
  std::atomic<std::uint8_t> version{firmware::kLineVersion};
};

class LineBoard {
 public:
  explicit LineBoard(const LineBoardImages& images);
  LineBoard(const LineBoard&) = delete;
  LineBoard& operator=(const LineBoard&) = delete;
  ~LineBoard();

  // Returns the path of the host's end.
  [[nodiscard]] const std::string& path() const { return line_.path(); }
  LineTroubles& troubles() { return troubles_; }
  // Ends the board and hangs up the line, as a pulled cable does.
  void pull_cable();

  // Return the state hash of a tick that was made; 0 if none was. Any thread.
  std::uint64_t hash_of(std::uint64_t tick);
  // Return what the board has heard. Any thread.
  [[nodiscard]] bool is_supervised() const { return is_supervised_; }
  [[nodiscard]] std::uint32_t image_asks() const { return image_asks_; }
  // True: the board would have taken its motors' power away, since the host was silent for too
  // long.
  [[nodiscard]] bool has_lost_host() const { return has_lost_host_; }

 private:
  void run(const std::stop_token& stop);
  void receive();
  void hear(std::span<const std::byte> message);
  void send_image(const firmware::AskImage& ask);
  void tick();
  template <class Message>
  void send(const Message& message);
  void send_bytes(std::span<const std::byte> bytes);
  [[nodiscard]] firmware::Hello hello() const;

  const LineBoardImages& images_;
  PseudoTerminal line_;
  std::unique_ptr<firmware::LoadedController> loaded_ =
      std::make_unique<firmware::LoadedController>();
  firmware::HeldHandle handle_;
  firmware::CommandQueue queue_;
  firmware::FrameReader reader_;
  std::uint32_t every_ = 0;
  bool has_begun_ = false;
  std::uint32_t frames_ = 0;
  bool stop_waits_ = false;
  firmware::Ticket stop_ticket_ = 0;
  hal::TimeNs heard_ns_ = 0;
  std::mutex mutex_;
  std::vector<std::uint64_t> hashes_;
  std::atomic<bool> is_supervised_{false};
  std::atomic<std::uint32_t> image_asks_{0};
  std::atomic<bool> has_lost_host_{false};
  LineTroubles troubles_;
  std::jthread thread_;
};

}  // namespace tactus::host
