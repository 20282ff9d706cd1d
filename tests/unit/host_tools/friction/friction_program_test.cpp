// `tactus friction` and `tactus fit`, as a user runs them.
#include <gtest/gtest.h>

#include <algorithm>

#include "host_tools/files/atomic_file.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::Outcome;
using testing::TemporaryFolder;

class FrictionProgram : public ::testing::Test {
 protected:
  Outcome run(const std::string& arguments) {
    return testing::run_program(folder.path(), arguments);
  }

  void expect_refused(const std::string& arguments, std::string_view message) {
    const Outcome result = run(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_TRUE(contains(result.output, message));
    EXPECT_EQ(std::ranges::count(result.output, '\n'), 1) << result.output;
  }

  std::string file(const std::string& name) { return read_file(folder.path() / name); }

  TemporaryFolder folder;
};

TEST_F(FrictionProgram, RunsTheThreeTasks) {
  (void)folder.write("motion.csv", "t_s,x_m\n0,0\n0.001,1e-6\n0.002,3e-6\n");
  (void)folder.write("push.csv", "t_s,force_N\n0,0\n0.1,1\n");
  const std::string lugre =
      "friction --model lugre --param sigma0=1e5 --param sigma1=316.228 --param sigma2=0.4 --param "
      "Fc=1 --param Fs=1.5 --param vs=0.001 ";
  EXPECT_EQ(run(lugre + "--motion motion.csv --output out.csv").output, "out.csv: 3 rows\n");
  EXPECT_TRUE(file("out.csv").starts_with("t_s,x_m,v_m_per_s,force_N,bristle_m\n0,0,0,0,0\n"));
  EXPECT_EQ(run(lugre + "--push push.csv --mass-kg 1 --output out.csv").output,
            "out.csv: 101 rows\n");
  const Outcome experiment =
      run(lugre + "--experiment stick-slip --rate-hz 4000 --output out.csv --json");
  EXPECT_EQ(experiment.exit_code, 0);
  EXPECT_TRUE(contains(experiment.output, "\"experiment\":\"stick-slip\",\"rows\":160001"));
  EXPECT_TRUE(contains(experiment.output, "\"period_s\":6.36"));
  EXPECT_EQ(std::ranges::count(experiment.output, '\n'), 1);
}

TEST_F(FrictionProgram, SaysWhatIsWrongInOneLine) {
  (void)folder.write("bad.csv", "t_s,x_m\n0,0\n0.1,oops\n");
  expect_refused("friction --motion bad.csv --output o.csv",
                 "tactus friction: bad.csv:3: column x_m: 'oops' is not a finite number");
  expect_refused("friction --motion none.csv --output o.csv",
                 "tactus friction: none.csv: no such file");
  expect_refused("friction", "say what to do: one of --motion, --push and --experiment");
  expect_refused("friction --motion a.csv --push b.csv", "say what to do");
  expect_refused("friction --motion a.csv", "say where to put the result");
  expect_refused("friction --experiment lag --model glue", "there is no friction model 'glue'");
  expect_refused("friction --experiment lag --param sigma3=1", "sigma0 (N/m), sigma1 (N s/m)");
  expect_refused("friction --experiment lag --mass-kg 0", "tactus friction: --mass-kg");
  expect_refused("fit none.csv", "tactus fit: none.csv: no such file");
  expect_refused("fit bad.csv", "tactus fit: bad.csv:1: no column force_N");
  expect_refused("fit bad.csv --model karnopp", "fitted are coulomb, stribeck, dahl and lugre");
}

TEST_F(FrictionProgram, FitsTheExampleAndWritesItsToml) {
  const std::string record =
      " '" + testing::in_repository("host_tools/examples/friction/record.csv") + "' ";
  const Outcome all = run("fit" + record + "--output friction.toml --figure fit.png");
  EXPECT_EQ(all.exit_code, 0) << all.output;
  EXPECT_TRUE(contains(all.output, "which the AIC prefers\n  Fc     1.00"));
  EXPECT_TRUE(contains(all.output, "sigma2 the data cannot tell: not to be told from 0"));
  EXPECT_TRUE(contains(file("friction.toml"), "[object.friction]\nmodel = \"lugre\"\n"));
  EXPECT_TRUE(std::filesystem::exists(folder.path() / "fit.png"));
  const Outcome one = run("fit" + record + "--model dahl --json --joint --output joint.toml");
  EXPECT_TRUE(contains(one.output, "\"preferred\":\"dahl\""));
  EXPECT_TRUE(contains(one.output, "{\"name\":\"sigma0\",\"unit\":\"N/m\",\"value\":1"));
  EXPECT_TRUE(contains(file("joint.toml"), "[joint.friction]\nmodel = \"dahl\"\ncoulomb_N = "));
}

TEST_F(FrictionProgram, WhatItFitsBakes) {
  const std::string record =
      " '" + testing::in_repository("host_tools/examples/friction/record.csv") + "' ";
  for (const char* model : {"coulomb", "stribeck"}) {
    ASSERT_EQ(run("fit" + record + "--model " + model + " -o friction.toml").exit_code, 0);
    (void)folder.write("scene.toml", "[[object]]\nprimitive = \"sphere\"\nradius_m = 0.05\n" +
                                         file("friction.toml"));
    const Outcome bake = run("bake scene.toml");
    EXPECT_EQ(bake.exit_code, 0) << bake.output;
  }
}

TEST_F(FrictionProgram, HelpEndsWithExamplesAndNamesUnits) {
  const Outcome friction = run("friction --help");
  EXPECT_TRUE(contains(friction.output, "Examples:\n  tactus friction --model lugre"));
  EXPECT_TRUE(contains(friction.output, "sigma1 N s/m (s/m) 316.228"));
  EXPECT_TRUE(contains(friction.output, "Kp_N_per_m        3"));
  EXPECT_TRUE(contains(run("fit --help").output, "Examples:\n  tactus fit stroke.csv"));
}

}  // namespace
}  // namespace tactus::host
