// What the command socket says to an answer: "ok ...", or "refused ...: why; what to do".
#pragma once

#include <cstdint>
#include <string_view>

#include "firmware/commands/command.h"
#include "firmware/commands/text_line.h"

namespace tactus::firmware {

// "refused enable: why", where no tick was asked.
void write_refusal(TextLine& line, std::string_view command, std::string_view why);

// "ok enable tick=7 mode=active", or the refusal in words. While homing, the hint is added in
// quotes as hint="...", if there is one.
void write_request_reply(TextLine& line, const Answer& answer, std::string_view homing_hint);

// "ok set tick=7 max_force_N=4 least=0 greatest=8 unit=N". Of `get` and `set`.
void write_parameter_reply(TextLine& line, std::string_view command, const ParameterPlace& place,
                           const Answer& answer);

// " max_force_N=4 least=0 greatest=8 unit=N"
void write_parameter(TextLine& line, const ParameterPlace& place, const ParameterValue& value);

// " tick=7 mode=active"
void write_tick(TextLine& line, const Answer& answer);

// "joint_limit,drive", or "none".
void write_faults(TextLine& line, std::uint64_t faults);

}  // namespace tactus::firmware
