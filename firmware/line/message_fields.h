// Visits the fields of the messages in the order in which they are on the line. A new field of a
// message gets its line here; tests hold the sizes of the structs against it. Pure functions for
// any thread.
//
// A tick has the fields of visit_tick_fields (firmware/telemetry/record_fields.h).
#pragma once

#include <cstddef>

#include "firmware/line/message.h"

namespace tactus::firmware {

// A number of type std::size_t, which has 32 bits on the line whatever the machine has.
template <class Size>
struct LineSize {
  Size& number;
};

// Calls visit(field) for each field. Message is one of the messages, const or not.
template <class Message, class Visit>
void visit_hello_fields(Message& hello, Visit&& visit) {
  visit(hello.version);
  visit(hello.board);
  visit(hello.profile);
  visit(hello.rate_hz);
  visit(hello.joints);
  visit(hello.device.checksum);
  visit(hello.device.bytes);
  visit(hello.scene.checksum);
  visit(hello.scene.bytes);
  visit(hello.next_tick);
  visit(hello.most_waiting);
  visit(hello.room_bytes);
  visit(hello.broken_frames);
  visit(hello.lost_bytes);
}

// Visits the fields of an answer but those that the command `scene` alone sets, which no line
// carries: of scene_refusal there is the part.
template <class Message, class Visit>
void visit_answer_fields(Message& answer, Visit&& visit) {
  visit(answer.ticket);
  visit(answer.kind);
  visit(answer.outcome);
  visit(answer.request);
  visit(answer.before);
  visit(answer.after);
  visit(answer.refusal);
  visit(answer.tick);
  visit(answer.faults);
  visit(answer.value.value);
  visit(answer.value.least);
  visit(answer.value.greatest);
  visit(answer.value.choices);
  auto& part = answer.scene_refusal.part;
  visit(part.kind);
  visit(LineSize{part.index});
  visit(part.stiffness_N_per_m);
  visit(part.damping_Ns_per_m);
  visit(part.limit_N_per_m);
  visit(part.most_damping_Ns_per_m);
  visit(LineSize{part.other_count});
  visit(LineSize{part.listed});
  for (auto& other : part.others) {
    visit(other.kind);
    visit(LineSize{other.index});
  }
}

// Visits the fields of a command but `scene` and `injection`, which no line carries.
template <class Message, class Visit>
void visit_command_fields(Message& command, Visit&& visit) {
  visit(command.kind);
  visit(command.ticket);
  visit(command.request);
  visit(command.change.place.parameter);
  visit(command.change.place.object);
  visit(command.change.value);
}

template <class Message, class Visit>
void visit_ask_ticks_fields(Message& ask, Visit&& visit) {
  visit(ask.every);
}

template <class Message, class Visit>
void visit_ask_image_fields(Message& ask, Visit&& visit) {
  visit(ask.image);
  visit(ask.offset);
  visit(ask.bytes);
}

template <class Message, class Visit>
void visit_stop_fields(Message& stop, Visit&& visit) {
  visit(stop.ticket);
}

}  // namespace tactus::firmware
