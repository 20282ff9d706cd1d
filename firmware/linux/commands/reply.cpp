#include "firmware/linux/commands/reply.h"

#include <array>

#include "firmware/control/parameter_choices.h"
#include "firmware/control/parameter_name.h"
#include "firmware/safety/faults.h"

namespace tactus::firmware {
namespace {

// Returns the text that says why the request had no effect in its mode and what to do.
std::string_view remedy(Request request, const Answer& answer) {
  if (answer.after == Mode::fault) {
    return request == Request::reset ? "remove the cause, then send reset again"
                                     : "send reset first";
  }
  switch (answer.after) {
    case Mode::init:
      return request == Request::enable ? "send home first" : "send it again";
    case Mode::homing:
      return "homing is under way; wait until the mode is ready";
    case Mode::active:
      return "send disable first";
    default:
      return "send it again";
  }
}

// Writes the names of the allowed values with commas.
void write_choices(TextLine& line, Parameter parameter, const ParameterValue& range) {
  bool first = true;
  for_each_choice(parameter, range, [&](std::string_view name) {
    line.add(first ? "" : ",").add(name);
    first = false;
  });
}

}  // namespace

void write_refusal(TextLine& line, std::string_view command, std::string_view why) {
  line.add("refused ").add(command).add(": ").add(why).end();
}

void write_tick(TextLine& line, const Answer& answer) {
  line.add(" tick=").add(answer.tick).add(" mode=").add(mode_name(answer.after));
}

void write_faults(TextLine& line, std::uint64_t faults) {
  bool first = true;
  for (const FaultText& text : kFaultTexts) {
    if ((faults & kFaultMask & text.bit) != 0) {
      line.add(first ? "" : ",").add(text.name);
      first = false;
    }
  }
  line.add(first ? "none" : "");
}

void write_request_reply(TextLine& line, const Answer& answer, std::string_view homing_hint) {
  const std::string_view name = kRequestNames[static_cast<std::size_t>(answer.request)];
  switch (answer.outcome) {
    case Outcome::done:
      line.add("ok ").add(name);
      write_tick(line, answer);
      if (answer.after == Mode::homing && !homing_hint.empty()) {
        line.add(" hint=\"").add(homing_hint).add("\"");
      }
      line.end();
      return;
    case Outcome::superseded:
      write_refusal(line, name, "a newer request came before the next tick; send it again");
      return;
    case Outcome::estop_waits:
      write_refusal(line, name, "an estop comes first; send reset, then home");
      return;
    default:
      break;
  }
  line.add("refused ").add(name);
  write_tick(line, answer);
  line.add(": the mode is ").add(mode_name(answer.after));
  if (answer.after == Mode::fault) {
    line.add(" (");
    write_faults(line, answer.faults);
    line.add(")");
  }
  line.add("; ").add(remedy(answer.request, answer)).end();
}

void write_parameter(TextLine& line, const ParameterPlace& place, const ParameterValue& value) {
  std::array<char, kMaxParameterName> name{};
  const ParameterText* const text = text_of(place.parameter);
  line.add(" ").add(write_parameter_name(place, name)).add("=");
  if (has_choices(place.parameter)) {
    line.add(choice_name(place.parameter, value.value)).add(" choices=");
    write_choices(line, place.parameter, value);
    return;
  }
  line.add(value.value);
  line.add(" least=").add(value.least).add(" greatest=").add(value.greatest);
  line.add(" unit=").add(text == nullptr ? "" : text->unit);
}

void write_parameter_reply(TextLine& line, std::string_view command, const ParameterPlace& place,
                           const Answer& answer) {
  if (answer.outcome == Outcome::done) {
    line.add("ok ").add(command).add(" tick=").add(answer.tick);
    write_parameter(line, place, answer.value);
    line.end();
    return;
  }
  line.add("refused ").add(command).add(": ").add(describe(answer.refusal));
  if (answer.refusal == ParameterRefusal::not_a_choice) {
    line.add("; write one of ");
    write_choices(line, place.parameter, answer.value);
  } else if (answer.refusal == ParameterRefusal::out_of_range) {
    line.add(", ").add(answer.value.least).add(" to ").add(answer.value.greatest);
  }
  line.end();
}

}  // namespace tactus::firmware
