// The command socket's language on any bytes: refused with words, or a command whose parts are in
// bounds; and whatever a refusal quotes, it is one line that a terminal can show.
#include <algorithm>
#include <array>
#include <span>
#include <string_view>

#include "firmware/linux/commands/command_line.h"
#include "firmware/linux/commands/reply.h"
#include "tests/fuzz/fuzz_input.h"

namespace tactus {
namespace {

void check_taken(const firmware::CommandLine& command) {
  using firmware::Verb;
  const bool has_name = command.verb == Verb::set || command.verb == Verb::get;
  fuzz::require(has_name == (command.name.parameter != firmware::Parameter::none),
                "a parameter is named by set and get alone");
  fuzz::require((command.verb == Verb::request) == (command.request != firmware::Request::none),
                "a request is a command by itself");
  fuzz::require(
      command.injection.ticks >= 1 && command.injection.ticks <= firmware::kMaxInjectedTicks,
      "an injection ends");
  fuzz::require(command.verb != Verb::scene || !command.file.empty(), "a scene has a file");
  if (!has_name) {
    return;
  }
  const auto number = firmware::object_number(command.name.object);
  const firmware::ParameterPlace place{.parameter = command.name.parameter,
                                       .object = number.value_or(0)};
  std::array<char, firmware::kMaxParameterName> room{};
  const auto again = firmware::parse_parameter_name(firmware::write_parameter_name(place, room));
  fuzz::require(again && again->parameter == place.parameter, "a name is read as it is written");
}

}  // namespace
}  // namespace tactus

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace tactus;
  static std::array<char, firmware::kMaxCommandLine> line{};
  const std::size_t length = std::min(size, line.size() - 1);
  std::copy_n(data, length, line.begin());
  const std::string_view text(line.data(), length);
  const auto command = firmware::parse_command(text);
  firmware::TextLine reply;
  if (command) {
    check_taken(*command);
    reply.add(command->file).end();
  } else {
    firmware::write_refusal(reply, firmware::first_word(text), command.error());
  }
  const std::string_view said = reply.text();
  fuzz::require(said.ends_with('\n') && said.find('\n') + 1 == said.size(), "a reply is one line");
  fuzz::require(std::ranges::none_of(said.substr(0, said.size() - 1),
                                     [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; }),
                "a reply has no control characters");
  return 0;
}
