// Changes of state, counted in files whose sequence is known.
#include "host_tools/graph/transitions.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "host_tools/input_error.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/png_size.h"
#include "tests/support/run_program.h"
#include "tests/unit/host_tools/graph/graphs.h"

namespace tactus::host {
namespace {

class TransitionsTest : public FolderTest {
 protected:
  [[nodiscard]] std::string write(const std::string& text) const {
    std::ofstream(file("steps.csv")) << text;
    return file("steps.csv");
  }
  // A step as object 2, whose node 0 has the edge that node 1 has too.
  static std::vector<GraphedMesh> meshes() {
    std::vector<GraphedMesh> meshes(1);
    meshes[0].object = 2;
    meshes[0].graph = testing::graph_of(testing::step());
    return meshes;
  }
};

constexpr const char* kStepsHeader = "t_s,tick,row,object,feature,face,edge,vertex\n";

TEST_F(TransitionsTest, AreCountedInSteps) {
  const Transitions counted =
      count_transitions(write(std::string(kStepsHeader) + "0,0,tick,,0,,,\n"
                                                          "1,1,tick,0,1,5,,\n"
                                                          "2,2,move,0,3,1,,9\n"
                                                          "2,2,tick,0,1,5,,\n"
                                                          "3,3,tick,0,1,6,,\n"
                                                          "4,4,tick,0,2,6,1,\n"
                                                          "5,5,tick,0,3,6,,8\n"
                                                          "6,6,tick,0,3,6,,9\n"
                                                          "7,7,tick,1,3,6,,9\n"
                                                          "8,8,tick,1,1,6,,\n"
                                                          "9,9,tick,,0,,,\n"
                                                          "10,10,tick,,0,,,\n"),
                        {});
  using Counts = decltype(Transitions::counts);
  EXPECT_EQ(counted.counts, (Counts{{{1, 1, 0, 0}, {1, 2, 1, 0}, {0, 0, 0, 1}, {0, 1, 0, 2}}}));
  EXPECT_EQ(counted.ticks, 11U);
  EXPECT_EQ(counted.ticks_in, (std::array<std::size_t, 4>{3, 4, 1, 3}));
  EXPECT_EQ(counted.to_another, (std::array<std::size_t, 4>{0, 1, 0, 1}));
  EXPECT_EQ(counted.object_changes, 1U);
  EXPECT_EQ(counted.changes(), 5U);
}

TEST_F(TransitionsTest, TakeTheFeatureOfAWalkFromItsOwnRow) {
  const Transitions counted =
      count_transitions(write(std::string(kStepsHeader) + "0,0,feature,0,1,3,,\n"
                                                          "0,0,feature,1,1,7,,\n"
                                                          "0,0,tick,1,1,,,\n"
                                                          "1,1,feature,0,1,4,,\n"
                                                          "1,1,feature,1,1,7,,\n"
                                                          "1,1,tick,1,1,,,\n"
                                                          "2,2,feature,1,1,8,,\n"
                                                          "2,2,tick,1,1,,,\n"
                                                          "3,3,tick,1,1,,,\n"),
                        {});
  EXPECT_EQ(counted.to_another[1], 1U);
}

TEST_F(TransitionsTest, KnowAnEdgeFromBothOfItsFacesByTheMesh) {
  const std::vector<GraphedMesh> known = meshes();
  const Connection& shared = known[0].graph.connections[2];
  ASSERT_EQ(shared.nodes.size(), 2U);
  std::string text = kStepsHeader;
  for (const ConnectedNode& side : shared.nodes) {
    text += "0,0,tick,2,2," + std::to_string(side.node) + "," + std::to_string(side.edge) + ",\n";
  }
  text += "0,0,tick,2,2,0,0,\n";
  EXPECT_EQ(count_transitions(write(text), known).to_another[2], 1U);
  EXPECT_EQ(count_transitions(write(text), {}).to_another[2], 2U);
  EXPECT_THROW(static_cast<void>(count_transitions(
                   write(kStepsHeader + std::string("0,0,tick,2,2,99,0,\n")), known)),
               InputError);
}

TEST_F(TransitionsTest, OfARunLeaveOutTicksBeforeHomingIsOver) {
  const Transitions counted = count_transitions(write("t_s,contact,object,mode\n"
                                                      "0,1,0,0\n"
                                                      "1,0,,2\n"
                                                      "2,2,0,3\n"
                                                      "3,0,,1\n"
                                                      "4,3,0,3\n"
                                                      "5,2,4,3\n"),
                                                {});
  EXPECT_EQ(counted.ticks, 4U);
  EXPECT_EQ(counted.counts[0][2], 1U);
  EXPECT_EQ(counted.counts[3][2], 1U);
  EXPECT_EQ(counted.changes(), 2U);
  EXPECT_EQ(counted.object_changes, 1U);
  EXPECT_FALSE(counted.has_features);
}

TEST_F(TransitionsTest, RefuseOtherFilesWithTheLine) {
  const auto message = [&](const std::string& text) {
    try {
      static_cast<void>(count_transitions(write(text), {}));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message("t_s,x\n0,1\n").find("no columns contact and object"), std::string::npos);
  EXPECT_NE(message("contact,object\n0,\n4,0\n").find("steps.csv:3: column contact: 4 is none"),
            std::string::npos);
  EXPECT_NE(message("contact,object\n0,\nx,0\n").find("steps.csv:3: column contact: 'x'"),
            std::string::npos);
  EXPECT_NE(message("contact,object\n0\n").find("steps.csv:2: 1 fields"), std::string::npos);
  EXPECT_NE(message("contact,object\n").find("no tick"), std::string::npos);
}

TEST_F(TransitionsTest, OfTheNotchGoThroughAllStatesAndAreDrawn) {
  const std::string notch = testing::in_repository("host_tools/examples/notch");
  const auto run = [&](const std::string& arguments) {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
    return outcome.output;
  };
  run("bake '" + notch + "/scene.toml' -o scene.tactus");
  run("touch scene.tactus --path '" + notch + "/stroke.csv' -o run.csv --explain steps.csv");
  const std::string text = run("plot steps.csv --transitions --scene scene.tactus");
  EXPECT_NE(text.find("8 changes of state"), std::string::npos) << text;
  EXPECT_EQ(testing::png_size(file("steps_transitions.png")).width, 1300U);
  run("plot run.csv --transitions -o figures/all.png");
  EXPECT_EQ(testing::png_size(file("figures/all.png")).width, 1300U);
  const Transitions steps = count_transitions(file("steps.csv"), {});
  const Transitions of_run = count_transitions(file("run.csv"), {});
  EXPECT_EQ(steps.counts, of_run.counts);
  // The stroke lands on the floor of the notch, goes into the groove, the corner, the other groove,
  // and up the wall; it is free above that and lands on the top.
  EXPECT_EQ(steps.counts[1][2], 1U);
  EXPECT_EQ(steps.counts[2][3], 1U);
  EXPECT_EQ(steps.counts[3][2], 1U);
  EXPECT_EQ(steps.counts[2][1], 1U);
  EXPECT_EQ(steps.counts[1][0], 2U);
  EXPECT_EQ(testing::run_program(folder(), "plot run.csv").exit_code, 2);
}

}  // namespace
}  // namespace tactus::host
