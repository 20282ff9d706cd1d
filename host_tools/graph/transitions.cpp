#include "host_tools/graph/transitions.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

#include "host_tools/csv/csv_text.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

// The number of the mode `ready` in firmware::Mode: from it on the controller knows where the tool
// is.
constexpr std::uint32_t kLeastLocatedMode = 2;

// A face by its number; an edge by its connection's number, or by face and edge where that is not
// known; a vertex by its number. kUnknownFeature if the run does not tell.
using FeatureNumber = std::array<std::uint32_t, 2>;
constexpr FeatureNumber kUnknownFeature = {0xffffffff, 0xffffffff};

// The state of one tick.
struct Seen {
  // False if the controller did not know where the tool was.
  bool is_located = false;
  std::size_t state = 0;
  std::uint32_t object = 0;
  FeatureNumber feature = kUnknownFeature;
};

// The columns of a run or of steps, one row at a time.
class StateReader {
 public:
  StateReader(std::string file, std::string_view text) : file_(std::move(file)), text_(text) {
    if (const std::vector<std::string>* const header = text_.next()) {
      header_ = *header;
    }
    has_steps_ = has("row") && has("feature");
    if (!has("object") || (!has_steps_ && !has("contact"))) {
      throw InputError(fmt::format(
          "{}: it has no columns contact and object, as the CSV of tactus sim and touch, nor row, "
          "feature and object, as the steps of --explain",
          file_));
    }
  }

  // Goes to the next row that tells the state of a tick. Returns false at the end.
  bool next() {
    walked_.clear();
    do {
      fields_ = text_.next();
      if (fields_ != nullptr && fields_->size() != header_.size()) {
        throw InputError(fmt::format("{}:{}: {} fields, but the header has {}", file_,
                                     text_.number(), fields_->size(), header_.size()));
      }
      if (fields_ != nullptr && has_steps_ && text("row") == "feature") {
        walked_.push_back(named_feature());
      }
    } while (fields_ != nullptr && has_steps_ && text("row") != "tick");
    return fields_ != nullptr;
  }

  // Returns the state of the row.
  [[nodiscard]] Seen seen(const std::vector<GraphedMesh>& meshes) const {
    if (has("mode") && number("mode").value_or(kLeastLocatedMode) < kLeastLocatedMode) {
      return {};
    }
    const std::string_view column = has_steps_ ? "feature" : "contact";
    Seen seen{.is_located = true, .state = number(column).value_or(0)};
    if (seen.state >= kContactStates) {
      throw InputError(
          fmt::format("{}:{}: column {}: {} is none of 0 (free), 1 (face), 2 (edge), 3 (vertex)",
                      file_, text_.number(), column, seen.state));
    }
    seen.object = number("object").value_or(0);
    if (has_steps_ && seen.state != 0) {
      seen.feature = feature(seen.object, seen.state, meshes);
    }
    return seen;
  }

 private:
  [[nodiscard]] bool has(std::string_view column) const {
    return std::ranges::find(header_, column) != header_.end();
  }
  [[nodiscard]] const std::string& text(std::string_view column) const {
    return (
        *fields_)[static_cast<std::size_t>(std::ranges::find(header_, column) - header_.begin())];
  }

  // Returns the number, or nothing if the field is empty or there is no such column.
  [[nodiscard]] std::optional<std::uint32_t> number(std::string_view column) const {
    if (!has(column) || text(column).empty()) {
      return std::nullopt;
    }
    const std::string& field = text(column);
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
      throw InputError(fmt::format("{}:{}: column {}: '{}' is not a number from 0 up", file_,
                                   text_.number(), column, field));
    }
    return value;
  }

  // A row's feature.
  struct NamedFeature {
    std::uint32_t object = 0;
    std::size_t state = 0;
    std::optional<std::uint32_t> face;
    std::optional<std::uint32_t> edge;
    std::optional<std::uint32_t> vertex;
  };

  [[nodiscard]] NamedFeature named_feature() const {
    return {.object = number("object").value_or(0),
            .state = number("feature").value_or(0),
            .face = number("face"),
            .edge = number("edge"),
            .vertex = number("vertex")};
  }

  // Returns the feature of a tick: a walked one, which has a row of its own, or that of the tick.
  [[nodiscard]] FeatureNumber feature(std::uint32_t object, std::size_t state,
                                      const std::vector<GraphedMesh>& meshes) const {
    const auto walked = std::ranges::find_if(walked_, [&](const NamedFeature& feature) {
      return feature.object == object && feature.state == state;
    });
    const NamedFeature feature = walked == walked_.end() ? named_feature() : *walked;
    if (state == 3 && feature.vertex) {
      return {*feature.vertex, 0};
    }
    if (state == 1 && feature.face) {
      return {*feature.face, 0};
    }
    return state == 2 && feature.face && feature.edge
               ? edge_number(object, *feature.face, *feature.edge, meshes)
               : kUnknownFeature;
  }

  [[nodiscard]] FeatureNumber edge_number(std::uint32_t object, std::uint32_t face,
                                          std::uint32_t edge,
                                          const std::vector<GraphedMesh>& meshes) const {
    const auto mesh = std::ranges::find(meshes, object, &GraphedMesh::object);
    if (mesh == meshes.end()) {
      return {face, edge};
    }
    if (face >= mesh->graph.nodes.size() || edge >= 3) {
      throw InputError(fmt::format(
          "{}:{}: object {} of the scene has no edge {} of face {}; name the scene of the run",
          file_, text_.number(), object, edge, face));
    }
    return {mesh->graph.nodes[face].connections[edge], 0};
  }

  std::string file_;
  CsvText text_;
  std::vector<std::string> header_;
  bool has_steps_ = false;
  const std::vector<std::string>* fields_ = nullptr;
  // The features of the walks of the tick, which come before its row.
  std::vector<NamedFeature> walked_;
};

void add(Transitions& transitions, const Seen& before, const Seen& now) {
  ++transitions.counts[before.state][now.state];
  if (before.state == 0 || now.state == 0) {
    return;
  }
  if (before.object != now.object) {
    ++transitions.object_changes;
  } else if (before.state == now.state && before.feature != kUnknownFeature &&
             now.feature != kUnknownFeature && before.feature != now.feature) {
    ++transitions.to_another[now.state];
  }
}

double percent(std::size_t part, std::size_t whole) {
  return 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(whole, 1));
}

}  // namespace

std::size_t Transitions::changes() const {
  std::size_t sum = 0;
  for (std::size_t from = 0; from < kContactStates; ++from) {
    for (std::size_t to = 0; to < kContactStates; ++to) {
      sum += from == to ? 0 : counts[from][to];
    }
  }
  return sum;
}

Transitions count_transitions(const std::filesystem::path& file,
                              const std::vector<GraphedMesh>& meshes) {
  const std::string text = read_file(file);
  Transitions transitions;
  Seen before;
  for (StateReader rows(file.string(), text); rows.next();) {
    const Seen now = rows.seen(meshes);
    if (now.is_located) {
      ++transitions.ticks;
      ++transitions.ticks_in[now.state];
      transitions.has_features = transitions.has_features || now.feature != kUnknownFeature;
    }
    if (before.is_located && now.is_located) {
      add(transitions, before, now);
    }
    before = now;
  }
  if (transitions.ticks == 0) {
    throw InputError(fmt::format("{}: it has no tick with a state", file.string()));
  }
  return transitions;
}

std::string transitions_text(const Transitions& transitions, const std::string& name) {
  std::string text = fmt::format("{}: {} ticks, {} changes of state\n{:<14}", name,
                                 transitions.ticks, transitions.changes(), "from \\ to");
  for (const char* state : kStateNames) {
    fmt::format_to(std::back_inserter(text), "{:>10}", state);
  }
  text += "     ticks\n";
  for (std::size_t from = 0; from < kContactStates; ++from) {
    fmt::format_to(std::back_inserter(text), "  {:<12}", kStateNames[from]);
    for (const std::size_t number : transitions.counts[from]) {
      fmt::format_to(std::back_inserter(text), "{:>10}", number);
    }
    fmt::format_to(std::back_inserter(text), "{:>10}  {:.1f} %\n", transitions.ticks_in[from],
                   percent(transitions.ticks_in[from], transitions.ticks));
  }
  for (std::size_t state = 1; transitions.has_features && state < kContactStates; ++state) {
    fmt::format_to(std::back_inserter(text), "{} to another {}: {}\n", kStateNames[state],
                   kStateNames[state], transitions.to_another[state]);
  }
  fmt::format_to(std::back_inserter(text), "one object to another: {}\n",
                 transitions.object_changes);
  return text;
}

}  // namespace tactus::host
