// `tactus compare` as a user runs it, on the groove of the course.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

using testing::in_repository;
using testing::Outcome;
using testing::run_program;

class CompareProgram : public FolderTest {
 protected:
  [[nodiscard]] Outcome run(const std::string& arguments) const {
    return run_program(folder(), arguments);
  }
};

const std::string kGroove = in_repository("host_tools/examples/course/04_groove/scene.toml");
const std::string kGroovePath = in_repository("host_tools/examples/course/04_groove/path.csv");

TEST_F(CompareProgram, ShowsThatOnePlaneLosesTheGrooveAndTheGodObjectDoesNot) {
  const Outcome outcome = run("compare " + kGroove + " --path " + kGroovePath +
                              " --methods one_plane,god_object --rates 1000 --from 0.2 --to 0.8 "
                              "--json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  const nlohmann::json json = nlohmann::json::parse(outcome.output);
  EXPECT_EQ(json["scene"], kGroove);
  const nlohmann::json& runs = json["runs"];
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0]["name"], "one_plane");
  EXPECT_EQ(runs[0]["ticks"], 1001);
  EXPECT_GE(runs[0]["breaks"], 1);
  EXPECT_EQ(runs[0]["off_m"], 0.0) << "the first run is the one that the others are held against";
  EXPECT_EQ(runs[1]["name"], "god_object");
  EXPECT_EQ(runs[1]["breaks"], 0);
  EXPECT_LT(runs[0]["contact_ticks"], 100);
  EXPECT_GT(runs[1]["contact_ticks"], 400);
  EXPECT_GT(runs[1]["off_m"], 1e-3);
  EXPECT_GT(runs[1]["force_off_N"], 1.0);
  EXPECT_EQ(runs[1]["below_m"], 0.0);
}

TEST_F(CompareProgram, WritesEachRunAsTouchDoes) {
  const Outcome compared = run("compare " + kGroove + " --path " + kGroovePath +
                               " --methods three_sub_goals,one_step --push-outs 0.001,0.5 "
                               "--csv runs");
  ASSERT_EQ(compared.exit_code, 0) << compared.output;
  EXPECT_NE(compared.output.find("three_sub_goals, push-out 0.001 mm"), std::string::npos);
  for (const std::string method : {"three_sub_goals", "one_step"}) {
    std::string scene = read_file(kGroove);
    const std::string mesh = "mesh = \"";
    scene.replace(scene.find(mesh), mesh.size(),
                  mesh + in_repository("host_tools/examples/course/04_groove/"));
    const std::string contact = "contact = \"one_plane\"";
    scene.replace(scene.find(contact), contact.size(),
                  "contact = \"" + method + "\"\npush_out_mm = 0.5");
    std::ofstream(file("scene.toml")) << scene;
    ASSERT_EQ(run("bake scene.toml -o scene.tactus").exit_code, 0);
    const Outcome touched = run("touch scene.tactus --path " + kGroovePath + " -o touch.csv");
    ASSERT_EQ(touched.exit_code, 0) << touched.output;
    EXPECT_EQ(read_file(file("runs/" + method + "_push-out_0.5_mm.csv")),
              read_file(file("touch.csv")));
  }
}

TEST_F(CompareProgram, RefusesImagesAndUnknownMethods) {
  const Outcome image = run("compare scene.tactus --path path.csv");
  EXPECT_NE(image.exit_code, 0);
  EXPECT_NE(image.output.find("compare bakes the scene anew for each run; name scene.toml"),
            std::string::npos)
      << image.output;
  const Outcome method =
      run("compare " + kGroove + " --path " + kGroovePath + " --methods two_plane");
  EXPECT_NE(method.exit_code, 0);
  EXPECT_NE(method.output.find("there is no contact method \"two_plane\""), std::string::npos);
}

}  // namespace
}  // namespace tactus::host
