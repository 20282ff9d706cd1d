#include "host_tools/friction/friction_figures.h"

#include <gtest/gtest.h>

#include "tests/support/png_size.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::host {
namespace {

using testing::png_size;
using testing::published;
using testing::TemporaryFolder;

TEST(FrictionFigures, EveryExperimentHasOne) {
  const TemporaryFolder folder;
  for (const Experiment& known : experiments()) {
    const ExperimentRun run{.friction = published(rendering::FrictionKind::lugre),
                            .setup = known.setup()};
    const std::filesystem::path png = folder.path() / "figure.png";
    std::filesystem::remove(png);
    draw_experiment(known, run, known.run(run).track, png);
    EXPECT_EQ(png_size(png).width, 1200U) << known.name;
  }
}

TEST(FrictionFigures, MotionsAndPushesHaveThemToo) {
  const TemporaryFolder folder;
  const TimeSeries series{.t_s = {0.0, 0.1, 0.2}, .value = {0.0, 1e-5, 0.0}};
  const auto friction = published(rendering::FrictionKind::lugre);
  draw_motion("it's a {motion}", run_motion({.friction = friction}, series),
              folder.path() / "motion.png");
  draw_push("push", run_push({.friction = friction}, series), folder.path() / "push.png");
  EXPECT_EQ(png_size(folder.path() / "motion.png").width, 1200U);
  EXPECT_EQ(png_size(folder.path() / "push.png").width, 1200U);
}

}  // namespace
}  // namespace tactus::host
