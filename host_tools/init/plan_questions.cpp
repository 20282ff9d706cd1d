#include "host_tools/init/plan_questions.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// A range of numbers with its unit.
struct Permitted {
  double least = 0.0;
  double most = 0.0;
  std::string_view unit;
};

double read_number(std::string_view text, const Permitted& permitted) {
  double value = 0.0;
  const char* const end = text.data() + text.size();
  const auto [stopped, error] = std::from_chars(text.data(), end, value);
  const bool is_good =
      error == std::errc{} && stopped == end && value >= permitted.least && value <= permitted.most;
  if (!is_good) {
    throw InputError(fmt::format("'{}': write a number from {} to {}{}{}", text, permitted.least,
                                 permitted.most, permitted.unit.empty() ? "" : " ",
                                 permitted.unit));
  }
  return value;
}

std::vector<double> read_numbers(std::string_view text, const Permitted& permitted) {
  std::vector<double> numbers;
  while (true) {
    const std::size_t comma = text.find(',');
    std::string_view item = text.substr(0, comma);
    item.remove_prefix(std::min(item.find_first_not_of(' '), item.size()));
    numbers.push_back(read_number(item, permitted));
    if (comma == std::string_view::npos) {
      return numbers;
    }
    text.remove_prefix(comma + 1);
  }
}

template <class Choice>
const Choice& read_choice(std::string_view text, std::span<const Choice> choices) {
  const auto found = std::ranges::find(choices, text, &Choice::name);
  if (found == choices.end()) {
    std::vector<std::string_view> names;
    std::ranges::transform(choices, std::back_inserter(names), &Choice::name);
    throw InputError(fmt::format("there is no '{}'; there are: {}", text, fmt::join(names, ", ")));
  }
  return *found;
}

// Returns a text with one line for each choice.
template <class Choice>
std::string choice_text(std::string_view question, std::span<const Choice> choices) {
  std::string text(question);
  for (const Choice& choice : choices) {
    fmt::format_to(std::back_inserter(text), "\n    {:14}{}", choice.name, choice.words);
  }
  return text;
}

std::string usual_lengths(const DevicePlan& plan) {
  // The boards belong to devices whose lengths are known.
  if (plan.drive->name == "falcon_usb") {
    return "0.06,0.1025,0.04,0.01443";
  }
  if (plan.drive->name == "haply_serial") {
    return "0.02,0.05,0.07";
  }
  std::vector<double> lengths;
  std::ranges::transform(plan.mechanism->lengths, std::back_inserter(lengths),
                         &PlannedLength::usual_m);
  return fmt::format("{}", fmt::join(lengths, ","));
}

bool is_board(const DevicePlan& plan) {
  return !plan.drive->mechanism.empty();
}

void ask_kind(const AskQuestion& ask, DevicePlan& plan) {
  ask({.option = "mechanism",
       .text = choice_text("Which mechanism?", planned_mechanisms()),
       .usual = "serial_arm"},
      [&](const std::string& text) { plan.mechanism = &read_choice(text, planned_mechanisms()); });
  ask({.option = "drive",
       .text = choice_text("Which drives turn its joints?", planned_drives()),
       .usual = "odrive_can"},
      [&](const std::string& text) {
        plan.drive = &read_choice(text, planned_drives());
        if (is_board(plan) && plan.drive->mechanism != plan.mechanism->name) {
          throw InputError(fmt::format("{} turns a {} only, no {}", plan.drive->name,
                                       plan.drive->mechanism, plan.mechanism->name));
        }
      });
}

void ask_geometry(const AskQuestion& ask, DevicePlan& plan) {
  std::vector<std::string_view> words;
  std::ranges::transform(plan.mechanism->lengths, std::back_inserter(words), &PlannedLength::words);
  ask({.option = "lengths",
       .text = fmt::format("Lengths in m ({})?", fmt::join(words, ", ")),
       .usual = usual_lengths(plan)},
      [&](const std::string& text) {
        // A shoulder may be at the height of the base.
        plan.lengths_m = read_numbers(text, {.least = 0.0, .most = 1.0, .unit = "m"});
        if (plan.lengths_m.size() != plan.mechanism->lengths.size()) {
          throw InputError(
              fmt::format("'{}': write {} lengths", text, plan.mechanism->lengths.size()));
        }
      });
  ask({.option = "handle-kg",
       .text = "Mass of the handle with what moves rigidly with it, kg?",
       .usual = fmt::format("{}", plan.mechanism->handle_kg)},
      [&](const std::string& text) {
        plan.handle_kg = read_number(text, {.least = 0.01, .most = 5.0, .unit = "kg"});
      });
}

void ask_shafts(const AskQuestion& ask, DevicePlan& plan) {
  ask({.option = "ratio",
       .text = plan.slides()
                   ? "Turn of the motor for 1 m of the slide, rad (1 / the drum's radius; "
                     "one for all or one for each)?"
                   : "Turns of the motor for a turn of the joint (one for all or one for "
                     "each)?",
       .usual = fmt::format("{}", is_board(plan) ? 1.0 : plan.mechanism->ratio)},
      [&](const std::string& text) {
        plan.ratios = read_numbers(text, {.least = 0.01, .most = 10000.0, .unit = ""});
        if (plan.ratios.size() == 1) {
          plan.ratios.assign(plan.joints(), plan.ratios.front());
        }
        if (plan.ratios.size() != plan.joints()) {
          throw InputError(fmt::format("'{}': write one ratio, or one for each of {} joints", text,
                                       plan.joints()));
        }
      });
  ask({.option = "counts",
       .text = "Counts of the encoder for a turn of the motor (four for each line)?",
       .usual = is_board(plan) ? (plan.drive->name == "falcon_usb" ? "9881" : "13824") : "16384"},
      [&](const std::string& text) {
        plan.counts_per_turn = read_number(text, {.least = 4.0, .most = 1e8, .unit = ""});
      });
  ask({.option = "torque-Nm",
       .text = "Largest torque of a motor at its shaft, N m?",
       .usual =
           plan.drive->name == "haply_serial"
               ? "0.123"
               : fmt::format("{}",
                             plan.drive->name == "falcon_usb" ? 0.45 : plan.mechanism->torque_Nm)},
      [&](const std::string& text) {
        plan.torque_Nm = read_number(text, {.least = 0.001, .most = 100.0, .unit = "N m"});
      });
  if (plan.drive->name != "vesc_can") {
    return;  // the others are commanded in N m
  }
  ask({.option = "torque-constant",
       .text = "Torque constant of the motors, N m/A?",
       .usual = "0.03"},
      [&](const std::string& text) {
        plan.torque_constant_Nm_per_A =
            read_number(text, {.least = 0.001, .most = 10.0, .unit = "N m/A"});
      });
}

void ask_bus(const AskQuestion& ask, DevicePlan& plan) {
  ask({.option = "connection",
       .text = fmt::format("{}?", plan.drive->connection_words),
       .usual = std::string(plan.drive->connection)},
      [&](const std::string& text) {
        if (text.empty() || text.find_first_of("\"\\\n") != std::string::npos) {
          throw InputError(fmt::format("'{}': write a name without quotes", text));
        }
        plan.connection = text;
      });
  ask({.option = "rate-hz",
       .text = "Ticks a second?",
       .usual = fmt::format("{}", usual_rate_hz(*plan.drive, plan.joints()))},
      [&](const std::string& text) {
        plan.rate_hz = read_number(text, {.least = 100.0, .most = 10000.0, .unit = "Hz"});
      });
}

}  // namespace

DevicePlan ask_plan(const AskQuestion& ask) {
  DevicePlan plan;
  ask_kind(ask, plan);
  ask_geometry(ask, plan);
  ask_shafts(ask, plan);
  ask_bus(ask, plan);
  return plan;
}

}  // namespace tactus::host
