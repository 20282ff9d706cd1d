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

#include "firmware/commands/command_queue.h"
#include "firmware/device_file/certificate_words.h"
#include "firmware/linux/commands/command_client.h"
#include "firmware/linux/commands/scene_store.h"

namespace tactus::firmware {

// The parts of the program, beside the loop, that a command can reach. The command thread calls the
// functions; a null function means that the program does not have that part.
struct RunHooks {
  // The first argument of each function.
  void* run = nullptr;
  // These return an empty text on success, or what is wrong and what to do.
  std::string_view (*start_recording)(void* run, std::string_view file) = nullptr;
  std::string_view (*stop_recording)(void* run) = nullptr;
  // Called after the loop has taken another scene. When it returns, nothing may refer to the
  // previous image.
  void (*scene_changed)(void* run, std::span<const std::byte> image) = nullptr;
  // Says why this device may not be enabled and what to do; empty if it may. Outlives the server.
  std::string_view enable_refusal;
  // Say why this controller takes no other scene, and no injected faults, and what to do; empty if
  // it may. They outlive the server.
  std::string_view scene_refusal;
  std::string_view inject_refusal =
      "this controller takes no faults from outside; start it with --allow-inject";
  // Says what the user has to do while the device homes; empty if nothing. Outlives the server.
  std::string_view homing_hint;
};

// The processor of one command socket.
class CommandProcessor {
 public:
  // All arguments must outlive this. `scenes` is null for a device that is not the controller's
  // first one: its clients cannot reach the scene and its objects. Each answer goes to the client
  // of `clients` that waits for it.
  CommandProcessor(CommandQueue& queue, SceneStore* scenes, std::span<CommandClient> clients)
      : queue_(queue), scenes_(scenes), clients_(clients) {}

  // Takes the program's parts. `allow_inject` accepts `inject` commands. Call before the first
  // line.
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
  // Starts the command of a line.
  void carry_out(CommandClient& client, const CommandLine& command);
  // Gives the command a ticket and posts it for the client.
  void ask(CommandClient& client, Command command);
  // Posts the client's command if the queue has room.
  void post(CommandClient& client);
  // Start the commands that need more than one step.
  void ask_parameter(CommandClient& client, const CommandLine& command);
  void ask_scene(CommandClient& client, std::string_view file);
  void ask_next_of_list(CommandClient& client);
  void switch_recording(CommandClient& client, std::string_view file);
  // Opens the file after the answer says that it may be opened, and posts the scene.
  void hand_scene_over(CommandClient& client, const Answer& answer);

  // Gives an answer to the client that waits for it.
  void deliver(const Answer& answer);
  // Makes the next scene the one in use, or drops it, as the answer says.
  void take_over_scene(const Answer& answer);
  // Write the reply to an answer.
  void reply(CommandClient& client, const Answer& answer);
  void reply_set(CommandClient& client, const Answer& answer);
  void reply_scene(CommandClient& client, const Answer& answer);
  void reply_status(CommandClient& client, const Answer& answer);
  void reply_list(CommandClient& client, const Answer& answer);

  // Returns the scene in use; null if there is none here.
  [[nodiscard]] const rendering::SceneImage* scene() const {
    return scenes_ == nullptr ? nullptr : scenes_->scene();
  }

  CommandQueue& queue_;
  SceneStore* scenes_;
  // The server's clients.
  std::span<CommandClient> clients_;
  RunHooks hooks_;
  bool allow_inject_ = false;
  hal::TimeNs now_ns_ = 0;
  Ticket last_ticket_ = 0;
  // The names of the parts of the scene that was refused last.
  PartNames refused_names_{};
  // The ticket of the `scene` command without an answer yet; 0: none.
  Ticket scene_ticket_ = 0;
};

}  // namespace tactus::firmware
