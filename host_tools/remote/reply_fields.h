// The fields of a controller's reply, as JSON for programs and as a table for people.
// firmware/linux/commands/README.md describes the replies.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/remote/remote.h"

namespace tactus::host {

// A field "name=value" of a line.
struct ReplyField {
  std::string name;
  std::string value;
};

// Returns the fields of a line in their order. A value in quotation marks may have blanks; a
// file, or the name of an object, reaches to the end of the line.
std::vector<ReplyField> fields_of(std::string_view line);
// Returns the value of the field of that name; nothing if the line has none.
std::optional<std::string> field_of(std::string_view line, std::string_view name);

// Returns a reply as an object: "ok", "command", and its fields, numbers as numbers. A parameter
// has "name", "value", its range or its choices; "parameters" are those of a list. "faults" are a
// list of names. A refusal has its text.
nlohmann::ordered_json json_of(const Reply& reply);

// Returns the parameters of a list's lines as a table with a line for each: its name, value, unit,
// and its range or choices.
std::string parameter_table(const std::vector<std::string>& lines);

}  // namespace tactus::host
