#include "host_tools/plot/tick_steps.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <ranges>
#include <string_view>
#include <utility>

#include "host_tools/csv/csv_text.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The rows of a file of steps, one at a time.
class StepsReader {
 public:
  StepsReader(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {
    const std::vector<std::string>* const header = text_.next();
    for (std::size_t i = 0; header != nullptr && i < header->size(); ++i) {
      columns_[(*header)[i]] = i;
    }
    for (const std::string_view needed :
         {"t_s", "tick", "row", "from_x_m", "goal_x_m", "to_x_m", "ending", "fate"}) {
      if (!columns_.contains(needed)) {
        throw InputError(fmt::format(
            "{}: it has no column {}; --explain of tactus touch, sim and replay writes such a file",
            file_, needed));
      }
    }
  }

  // Goes to the next row. Returns false at the end.
  bool next() {
    fields_ = text_.next();
    if (fields_ != nullptr && fields_->size() != columns_.size()) {
      throw InputError(fmt::format("{}:{}: {} fields, but the header has {}", file_, text_.number(),
                                   fields_->size(), columns_.size()));
    }
    return fields_ != nullptr;
  }

  [[nodiscard]] const std::string& text(std::string_view column) const {
    const auto found = columns_.find(column);
    if (found == columns_.end()) {
      throw InputError(fmt::format("{}: it has no column {}", file_, column));
    }
    return (*fields_)[found->second];
  }

  // Returns the number, or nothing if the field is empty.
  [[nodiscard]] std::optional<double> number(std::string_view column) const {
    const std::string& field = text(column);
    if (field.empty()) {
      return std::nullopt;
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
      throw InputError(fmt::format("{}:{}: column {}: '{}' is not a number", file_, text_.number(),
                                   column, field));
    }
    return value;
  }

  // Returns the vector in three columns, or nothing if the first field is empty.
  [[nodiscard]] std::optional<Vec3> vector(std::string_view prefix, std::string_view unit) const {
    const auto column = [&](char axis) { return fmt::format("{}{}{}", prefix, axis, unit); };
    const auto x = number(column('x'));
    if (!x) {
      return std::nullopt;
    }
    return Vec3{*x, number(column('y')).value_or(0.0), number(column('z')).value_or(0.0)};
  }

  // Returns the point in three columns, the origin if they are empty.
  [[nodiscard]] Vec3 point(std::string_view name) const {
    return vector(fmt::format("{}_", name), "_m").value_or(Vec3::Zero());
  }

  [[nodiscard]] std::size_t tick() const {
    return static_cast<std::size_t>(number("tick").value_or(0.0));
  }

 private:
  std::string file_;
  CsvText text_;
  std::map<std::string, std::size_t, std::less<>> columns_;
  const std::vector<std::string>* fields_ = nullptr;
};

// Returns the number of the tick that is meant.
std::size_t chosen(const std::string& file, std::string_view text, const TickChoice& choice) {
  std::map<std::size_t, std::size_t> moves;
  std::optional<std::size_t> at_time;
  for (StepsReader rows(file, text); rows.next();) {
    const std::string& kind = rows.text("row");
    std::size_t& count = moves[rows.tick()];
    count += kind == "move" || kind == "iteration" ? 1U : 0U;
    if (choice.t_s && !at_time && rows.number("t_s") >= choice.t_s) {
      at_time = rows.tick();
    }
  }
  if (moves.empty()) {
    throw InputError(fmt::format("{}: it has no rows", file));
  }
  const auto range =
      fmt::format("it has the ticks {} to {}", moves.begin()->first, moves.rbegin()->first);
  if (choice.number) {
    if (!moves.contains(*choice.number)) {
      throw InputError(fmt::format("{}: no tick {}; {}", file, *choice.number, range));
    }
    return *choice.number;
  }
  if (choice.t_s) {
    if (!at_time) {
      throw InputError(fmt::format("{}: no tick at {} s or later; {}", file, *choice.t_s, range));
    }
    return *at_time;
  }
  return std::ranges::max_element(moves, {}, [](const auto& entry) { return entry.second; })->first;
}

void add_move(const StepsReader& row, TickSteps& tick) {
  tick.moves.push_back({.from_W = row.point("from"),
                        .goal_W = row.point("goal"),
                        .to_W = row.point("to"),
                        .ending = row.text("ending"),
                        .static_radius_m = row.number("static_radius_m"),
                        .dynamic_radius_m = row.number("dynamic_radius_m")});
}

// An iteration of a formula is shown with the tangent plane under it.
void add_iteration(const StepsReader& row, TickSteps& tick) {
  add_move(row, tick);
  StepMove& move = tick.moves.back();
  const FormulaStep& formula = move.formula.emplace(FormulaStep{
      .object = static_cast<std::size_t>(row.number("object").value_or(0.0)),
      .normal_W = row.vector("normal_", ""),
      .height_m = row.number("height_m").value_or(std::numeric_limits<double>::infinity()),
      .tolerance_m = row.number("tolerance_m").value_or(0.0)});
  if (formula.normal_W && formula.height_m <= formula.tolerance_m) {
    move.planes.push_back({.surface_W = move.from_W - formula.height_m * *formula.normal_W,
                           .normal_W = *formula.normal_W,
                           .fate = "active"});
  }
}

void add_tick(const StepsReader& row, TickSteps& tick) {
  tick.t_s = row.number("t_s").value_or(0.0);
  tick.tool_W = row.point("tool");
  tick.from_W = row.point("from");
  tick.proxy_W = row.point("to");
  tick.surface_W = row.vector("surface_", "_m");
  tick.normal_W = row.vector("normal_", "");
  tick.depth_m = row.number("depth_m").value_or(0.0);
  tick.friction_before = static_cast<int>(row.number("friction_before").value_or(0.0));
  tick.friction = static_cast<int>(row.number("friction").value_or(0.0));
}

// Adds what a row says of its tick.
void add_row(const StepsReader& row, TickSteps& tick) {
  const std::string& kind = row.text("row");
  if (kind == "move") {
    add_move(row, tick);
  } else if (kind == "iteration") {
    add_iteration(row, tick);
  } else if (kind == "plane" && !tick.moves.empty()) {
    tick.moves.back().planes.push_back(
        {.surface_W = row.point("surface"),
         .normal_W = row.vector("normal_", "").value_or(Vec3::Zero()),
         .multiplier_m = row.number("multiplier_m").value_or(0.0),
         .fate = row.text("fate")});
  } else if (kind == "tick") {
    add_tick(row, tick);
  }
}

// Reads a number at the beginning of the text and removes it. Returns false if there is none.
bool take_number(std::string_view& text, std::size_t& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{}) {
    return false;
  }
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return true;
}

// Removes the mark at the beginning of the text. Returns false if it is not there.
bool take_mark(std::string_view& text, std::string_view mark) {
  if (!text.starts_with(mark)) {
    return false;
  }
  text.remove_prefix(mark.size());
  return true;
}

}  // namespace

TickRange parse_tick_range(std::string_view text) {
  std::string_view rest = text;
  TickRange range;
  const bool is_range = take_number(rest, range.first) && take_mark(rest, "..") &&
                        take_number(rest, range.last) &&
                        (!take_mark(rest, "/") || take_number(rest, range.step));
  if (!is_range || range.step == 0 || range.last < range.first || !rest.empty()) {
    throw InputError(fmt::format(
        "'{}' is no range of ticks; write FIRST..LAST or FIRST..LAST/STEP, such as 860..880/5",
        text));
  }
  return range;
}

TickSteps read_tick_steps(const std::filesystem::path& file, const TickChoice& choice) {
  const std::string text = read_file(file);
  TickSteps tick{.number = chosen(file.string(), text, choice)};
  for (StepsReader row(file.string(), text); row.next();) {
    if (row.tick() == tick.number) {
      add_row(row, tick);
    }
  }
  return tick;
}

std::vector<TickSteps> read_ticks(const std::filesystem::path& file, const TickRange& range) {
  const std::string text = read_file(file);
  // The ends are looked up first: the message of a missing one names those that there are.
  static_cast<void>(chosen(file.string(), text, {.number = range.first, .t_s = std::nullopt}));
  const std::size_t last = range.first + (range.count() - 1) * range.step;
  static_cast<void>(chosen(file.string(), text, {.number = last, .t_s = std::nullopt}));
  std::map<std::size_t, TickSteps> ticks;
  for (StepsReader row(file.string(), text); row.next();) {
    const std::size_t number = row.tick();
    if (number >= range.first && number <= last && (number - range.first) % range.step == 0) {
      TickSteps& tick = ticks[number];
      tick.number = number;
      add_row(row, tick);
    }
  }
  std::vector<TickSteps> result;
  result.reserve(ticks.size());
  for (std::size_t number = range.first; number <= last; number += range.step) {
    const auto found = ticks.find(number);
    if (found == ticks.end()) {
      throw InputError(fmt::format("{}: no tick {}", file.string(), number));
    }
    result.push_back(std::move(found->second));
  }
  return result;
}

std::optional<std::size_t> formula_of(std::span<const TickSteps> ticks) {
  for (const TickSteps& tick : std::views::reverse(ticks)) {
    for (const StepMove& move : std::views::reverse(tick.moves)) {
      if (move.formula) {
        return move.formula->object;
      }
    }
  }
  return std::nullopt;
}

}  // namespace tactus::host
