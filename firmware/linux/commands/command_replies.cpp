// The replies of a command processor: what a client reads after a tick has answered its command.
#include <array>

#include "firmware/device_file/certificate_words.h"
#include "firmware/linux/commands/command_processor.h"
#include "firmware/linux/commands/reply.h"

namespace tactus::firmware {

void CommandProcessor::reply(CommandClient& client, const Answer& answer) {
  TextLine& out = client.out();
  client.waiting.is_under_way = false;
  switch (client.waiting.verb) {
    case Verb::request:
      write_request_reply(out, answer, hooks_.homing_hint);
      break;
    case Verb::set:
      reply_set(client, answer);
      break;
    case Verb::get:
      write_parameter_reply(out, word_of(client.waiting), client.waiting.command.change.place,
                            answer);
      break;
    case Verb::list:
      reply_list(client, answer);
      break;
    case Verb::scene:
      reply_scene(client, answer);
      break;
    case Verb::inject:
      out.add("ok inject");
      write_tick(out, answer);
      out.add(" fault=").add(
          kInjectionTexts[static_cast<std::size_t>(client.waiting.command.injection.injection)]
              .name);
      out.add(" ticks=").add(client.waiting.command.injection.ticks).end();
      break;
    default:
      reply_status(client, answer);
      break;
  }
}

void CommandProcessor::reply_set(CommandClient& client, const Answer& answer) {
  if (answer.outcome == Outcome::parameter && answer.refusal == ParameterRefusal::uncertified &&
      scene() != nullptr) {
    const UncertifiedPart& part = answer.scene_refusal.part;
    std::array<char, kMaxCommandLine> room{};
    refuse(client, "set", uncertified_words(part, names_of(part, *scene()), room));
    return;
  }
  write_parameter_reply(client.out(), word_of(client.waiting), client.waiting.command.change.place,
                        answer);
}

void CommandProcessor::reply_scene(CommandClient& client, const Answer& answer) {
  if (client.waiting.is_asking) {
    client.waiting.is_under_way = true;
    hand_scene_over(client, answer);
    return;
  }
  if (answer.outcome == Outcome::scene) {
    std::array<char, kMaxCommandLine> room{};
    refuse(client, "scene", refusal_words(answer.scene_refusal, refused_names_, room));
    return;
  }
  TextLine& out = client.out();
  out.add("ok scene");
  write_tick(out, answer);
  out.add(" objects=").add(scene() == nullptr ? 0 : scene()->objects().size());
  out.add(" file=").add(scenes_->path()).end();
}

// Writes the reply to `status` and to `record`.
void CommandProcessor::reply_status(CommandClient& client, const Answer& answer) {
  TextLine& out = client.out();
  out.add("ok ").add(word_of(client.waiting));
  write_tick(out, answer);
  out.add(" faults=");
  write_faults(out, answer.faults);
  if (scenes_ != nullptr) {
    const std::string_view file = scenes_->path();
    out.add(" scene=").add(file.empty() ? "none" : file);
  }
  out.end();
}

void CommandProcessor::reply_list(CommandClient& client, const Answer& answer) {
  client.waiting.is_under_way = true;
  if (answer.outcome != Outcome::done) {
    return;
  }
  TextLine& out = client.out();
  const ParameterPlace& place = client.waiting.command.change.place;
  out.add("parameter");
  write_parameter(out, place, answer.value);
  if (is_of_object(place.parameter) && scene() != nullptr) {
    out.add(" object=").add(scene()->object_name(place.object));
  }
  out.end();
}

}  // namespace tactus::firmware
