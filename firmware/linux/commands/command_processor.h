// Carries out the command lines of all clients: parses a line, posts the command to the queue, and
// writes the tick's answer as a reply to the client.
//
// Only the command thread uses it. It is not real time and uses no heap.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "firmware/device_file/certificate_words.h"
#include "firmware/linux/commands/command_client.h"
#include "firmware/linux/commands/command_queue.h"
#include "firmware/linux/commands/scene_store.h"

namespace tactus::firmware {

// The parts of the program, beside the loop, that a command can reach. The command thread calls the
// functions; a null function means that the program does not have that part.
struct RunHooks {
  void* run = nullptr;  // passed to each function
  // Both return an empty text on success, or what is wrong and what to do.
  std::string_view (*start_recording)(void* run, std::string_view file) = nullptr;
  std::string_view (*stop_recording)(void* run) = nullptr;
  // Called after the loop has taken another scene. When it returns, nothing may refer to the
  // previous image.
  void (*scene_changed)(void* run, std::span<const std::byte> image) = nullptr;
  // Says why this device may not be enabled and what to do; empty if it may. Outlives the server.
  std::string_view enable_refusal;
  // Says what the user has to do while the device homes; empty if nothing. Outlives the server.
  std::string_view homing_hint;
};

class CommandProcessor {
 public:
  // All arguments must outlive this. Each answer goes to the client of `clients` that waits for it.
  CommandProcessor(CommandQueue& queue, SceneStore& scenes, std::span<CommandClient> clients)
      : queue_(queue), scenes_(scenes), clients_(clients) {}

  void configure(const RunHooks& hooks, bool allow_inject);

  // Sets the time that the next calls use, ns of hal::monotonic_now_ns.
  void set_time(hal::TimeNs now_ns) { now_ns_ = now_ns; }

  // Carries out one line of the client. `line` is complete and has no newline.
  void take(CommandClient& client, std::string_view line);

  // Posts an estop that stands behind lines not carried out yet. Its line gets its reply later.
  void raise_estop();

  // Writes the replies to all answers that the ticks have given since the last call.
  void deliver_answers();

  // Serves a client that waits: posts a command that found no room, asks for the next parameter of
  // a list, or refuses the command if the loop has not answered it for a second.
  void look_after(CommandClient& client);

  // Writes the reply "refused COMMAND: WHY".
  void refuse(CommandClient& client, std::string_view command, std::string_view why);
  // Refuses the command that the client waits for, and ends the wait.
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

  CommandQueue& queue_;
  SceneStore& scenes_;
  std::span<CommandClient> clients_;
  RunHooks hooks_;
  bool allow_inject_ = false;
  hal::TimeNs now_ns_ = 0;
  Ticket last_ticket_ = 0;
  PartNames refused_names_{};  // names of the parts of the scene that was refused last
  Ticket scene_ticket_ = 0;    // ticket of the `scene` command without an answer yet; 0: none
};

}  // namespace tactus::firmware
