// What the command thread does with a line: hands it to the tick through the desk, and writes to
// whoever asked what the tick made of it.
//
// The command thread's; not real time, no heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/commands/command_client.h"
#include "firmware/commands/command_desk.h"
#include "firmware/commands/scene_store.h"
#include "firmware/device/certificate_words.h"

namespace tactus::firmware {

// What else of the run a command reaches, each from the command thread; null: there is none.
struct RunHooks {
  void* run = nullptr;
  // Empty if it went well, or what is wrong and what to do.
  std::string_view (*start_recording)(void* run, std::string_view file) = nullptr;
  std::string_view (*stop_recording)(void* run) = nullptr;
  // The loop has taken another scene; when this returns, nobody may hold the one before.
  void (*scene_changed)(void* run, std::span<const std::byte> image) = nullptr;
  // Why nobody may enable this device, and what to do; empty if they may. Outlives the server.
  std::string_view enable_refusal;
  // What the user does while the device is homed; empty: nothing. Outlives the server.
  std::string_view homing_hint;
};

class CommandClerk {
 public:
  // All outlive it. Answers go to those of the clients that wait for them.
  CommandClerk(CommandDesk& desk, SceneStore& scenes, std::span<CommandClient> clients)
      : desk_(desk), scenes_(scenes), clients_(clients) {}

  void configure(const RunHooks& hooks, bool allow_inject);

  // The time of what follows, on hal::monotonic_now_ns.
  void set_time(hal::TimeNs now_ns) { now_ns_ = now_ns; }

  // A line that the client has said, complete and without its newline.
  void take(CommandClient& client, std::string_view line);

  // An estop that was heard among lines whose turn has not come yet; the line gets its reply later.
  void raise_estop();

  // Writes the answers that the ticks have left.
  void deliver_answers();

  // For a client that waits: the next of a list, or that the loop has not answered for too long.
  void look_after(CommandClient& client);

  void refuse(CommandClient& client, std::string_view command, std::string_view why);
  // What the client waits for cannot come any more.
  void refuse_waiting(CommandClient& client, std::string_view why);

 private:
  void carry_out(CommandClient& client, const CommandLine& command);
  void ask(CommandClient& client, Command command);
  void post(CommandClient& client);
  void ask_parameter(CommandClient& client, const CommandLine& command);
  void ask_scene(CommandClient& client, std::string_view file);
  void ask_next_of_list(CommandClient& client);
  void switch_recording(CommandClient& client, std::string_view file);
  void hand_scene_over(CommandClient& client, const Answer& answer);

  void deliver(const Answer& answer);
  void take_over_scene(const Answer& answer);
  void reply(CommandClient& client, const Answer& answer);
  void reply_set(CommandClient& client, const Answer& answer);
  void reply_scene(CommandClient& client, const Answer& answer);
  void reply_status(CommandClient& client, const Answer& answer);
  void reply_list(CommandClient& client, const Answer& answer);

  CommandDesk& desk_;
  SceneStore& scenes_;
  std::span<CommandClient> clients_;
  RunHooks hooks_;
  bool allow_inject_ = false;
  hal::TimeNs now_ns_ = 0;
  Ticket last_ticket_ = 0;
  PartNames refused_names_{};  // of the scene that was refused last
  Ticket scene_ticket_ = 0;    // of the scene that the loop has not answered yet; 0: none
};

}  // namespace tactus::firmware
