// Counts how a run goes from state to state: free space, face, edge, vertex.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "host_tools/graph/graph_source.h"

namespace tactus::host {

// The states, in the numbers of rendering::ContactKind.
inline constexpr std::size_t kContactStates = 4;
inline constexpr std::array<const char*, kContactStates> kStateNames = {"free", "face", "edge",
                                                                        "vertex"};

// The changes of state of a run.
struct Transitions {
  std::size_t ticks = 0;
  // The number of ticks in each state.
  std::array<std::size_t, kContactStates> ticks_in{};
  // counts[a][b]: how often the state a was followed by the state b; for a = b it stayed.
  std::array<std::array<std::size_t, kContactStates>, kContactStates> counts{};
  // The times that a state stayed while its face, edge or vertex became another one of the same
  // object. Zero if the run does not tell.
  std::array<std::size_t, kContactStates> to_another{};
  // The times that a contact of one object was followed by a contact of another one.
  std::size_t object_changes = 0;
  // True if the run tells which face, edge and vertex it was.
  bool has_features = false;

  // Returns the number of changes from one state to another.
  [[nodiscard]] std::size_t changes() const;
};

// Counts the transitions of a file of steps (--explain), or of the CSV of `tactus sim` or `tactus
// touch`. With the meshes of the scene an edge is the same from both of its faces; `meshes` may be
// empty. Rows in which the controller does not know where the tool is are left out. Throws
// InputError that names file, line and column.
Transitions count_transitions(const std::filesystem::path& file,
                              const std::vector<GraphedMesh>& meshes);

// Returns the table of counts and the sums below it.
std::string transitions_text(const Transitions& transitions, const std::string& name);

}  // namespace tactus::host
