// Writes the replies of the command socket: "ok ...", or "refused ...: why; what to do". Pure
// functions of their arguments; no heap. The examples show the text that each writes.
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/linux/commands/text_line.h"

namespace tactus::firmware {

// Writes "refused enable: why".
void write_refusal(TextLine& line, std::string_view command, std::string_view why);

// Writes "ok enable tick=7 mode=active", or the refusal. In mode `homing` it adds hint="..." unless
// the hint is empty.
void write_request_reply(TextLine& line, const Answer& answer, std::string_view homing_hint);

// Writes "ok set tick=7 max_force_N=4 least=0 greatest=8 unit=N", or the refusal. For `get` and
// `set`.
void write_parameter_reply(TextLine& line, std::string_view command, const ParameterPlace& place,
                           const Answer& answer);

// Writes " max_force_N=4 least=0 greatest=8 unit=N", or for a parameter with names
// " object.0.contact=one_plane choices=sphere_proxy,god_object,one_plane".
void write_parameter(TextLine& line, const ParameterPlace& place, const ParameterValue& value);

// Writes " tick=7 mode=active".
void write_tick(TextLine& line, const Answer& answer);

// Writes the names of the fault bits, as "joint_limit,drive", or "none".
void write_faults(TextLine& line, std::uint64_t faults);

}  // namespace tactus::firmware
