#include "host_tools/plot/figures.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "tests/support/png_size.h"
#include "tests/support/solid.h"
#include "tests/support/xml_check.h"

namespace tactus::host {
namespace {

using rendering::FrictionState;
using testing::png_size;
using testing::Solid;

RunData stroke(std::size_t rows) {
  RunData run;
  for (std::size_t i = 0; i < rows; ++i) {
    const double t = 0.001 * static_cast<double>(i);
    RunRow row{.t_s = t, .proxy_W = {0.05 * std::sin(t), 0.05 * std::cos(t), 0.0}};
    row.contact = i > rows / 4;
    row.force_N = row.contact ? 1.0 + std::sin(9.0 * t) : 0.0;
    row.force_W = row.force_N * Vec3(std::cos(t), std::sin(t), 0.0);
    row.depth_m = row.force_N / 800.0;
    row.friction = !row.contact        ? FrictionState::free
                   : (i / 50) % 2 == 0 ? FrictionState::stick
                                       : FrictionState::slip;
    run.rows.push_back(row);
  }
  return run;
}

std::filesystem::path fresh(const std::string& name) {
  std::filesystem::path file = std::filesystem::path(::testing::TempDir()) / name;
  std::filesystem::remove(file);
  return file;
}

TEST(Figures, ForceFigureIsAPicture) {
  const std::filesystem::path file = fresh("tactus it's_force.png");
  draw_force_figure(stroke(20000), "a run's title_with {marks}", file);
  EXPECT_EQ(png_size(file).width, 1600U);
  EXPECT_EQ(png_size(file).height, 1000U);
}

TEST(Figures, PathFigureIsAPicture) {
  const Solid ball(testing::icosphere(0.04, 3), rendering::Sides::one, {});
  const std::filesystem::path file = fresh("tactus_path.png");
  draw_path_figure(stroke(5000), {&ball.object(), 1}, "path", file);
  EXPECT_EQ(png_size(file).width, 1800U);
}

TEST(Figures, TwoRunsAreDrawnOverOneAnother) {
  const std::filesystem::path png = fresh("against.png");
  draw_against_figure({stroke(500), "one"}, {stroke(300), "other's"}, png);
  EXPECT_EQ(png_size(png).width, 1200U);
  EXPECT_EQ(png_size(png).height, 700U);
}

TEST(Figures, ARunOfOneRowWithoutContactIsDrawnToo) {
  const Solid ball(testing::icosphere(0.04, 1), rendering::Sides::one, {});
  const std::filesystem::path force = fresh("tactus_one_force.png");
  const std::filesystem::path path = fresh("tactus_one_path.png");
  draw_force_figure(stroke(1), "one row", force);
  draw_path_figure(stroke(1), {&ball.object(), 1}, "one row", path);
  EXPECT_GT(png_size(force).width, 0U);
  EXPECT_GT(png_size(path).width, 0U);
}

TEST(Figures, APlaceThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(draw_force_figure(stroke(10), "t", "/no/such/folder/x.png"), InputError);
}

TEST(Figures, MissingGnuplotIsNamedWithItsPackage) {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nowhere", 1);
  std::string message;
  try {
    draw_force_figure(stroke(10), "t", fresh("tactus_none.png"));
  } catch (const InputError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  EXPECT_NE(message.find("gnuplot-nox"), std::string::npos) << message;
}

std::string message_of(const std::filesystem::path& picture) {
  try {
    draw_force_figure(stroke(10), "t", picture);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

TEST(Figures, AnSvgFileIsWellFormedAndHasEveryLabel) {
  const std::filesystem::path file = fresh("figures.svg");
  draw_force_figure(stroke(2000), "run<1> & \"2\" \xff it's", file);
  const std::string text = read_file(file);
  EXPECT_EQ(testing::xml_fault(text), "");
  for (const std::string_view label :
       {"run&lt;1> &amp; \"2\" ? it's", "force on the hand (N)", "depth (mm)", "time (s)", "stick",
        "slip", "rendered force"}) {
    EXPECT_NE(text.find(label), std::string::npos) << label;
  }
}

TEST(Figures, AnSvgFileHoldsThePictureBehindThePath) {
  const Solid ball(testing::icosphere(0.04, 3), rendering::Sides::one, {});
  const std::filesystem::path file = fresh("path.SVG");
  draw_path_figure(stroke(500), {&ball.object(), 1}, "path", file);
  const std::string text = read_file(file);
  EXPECT_EQ(testing::xml_fault(text), "");
  EXPECT_NE(text.find("data:image/png;base64,"), std::string::npos);
}

TEST(Figures, APdfFileHasOnePageInTheShapeOfThePicture) {
  const std::filesystem::path file = fresh("figures.pdf");
  draw_force_figure(stroke(2000), "run", file);
  const std::string text = read_file(file);
  EXPECT_TRUE(text.starts_with("%PDF-1."));
  EXPECT_NE(text.find("/MediaBox [ 0 0 800 500 ]"), std::string::npos);
  EXPECT_NE(text.find("/Count 1"), std::string::npos);
}

TEST(Figures, AnotherExtensionIsRefusedWithTheThreeThatAreKnown) {
  for (const std::string name : {"figure.jpg", "figure", "figure.", "figure.png2"}) {
    const std::string message = message_of(name);
    EXPECT_NE(message.find("a picture's name ends in .png, .svg or .pdf"), std::string::npos)
        << message;
    EXPECT_TRUE(message.starts_with(name)) << message;
  }
}

TEST(Figures, NamesKeepTheExtensionOfTheUser) {
  EXPECT_EQ(figure_files("new/ears.svg", "run").path, "new/ears_path.svg");
  EXPECT_EQ(figure_files("new/", "run", PictureFormat::pdf).path, "new/run_path.pdf");
  EXPECT_EQ(figure_files("speed0.5", "run").path, "speed0.5_path.png");
  EXPECT_THROW(static_cast<void>(figure_files("ears.jpg", "run")), InputError);
  EXPECT_EQ(figure_file("new/one.svg", "steps", "_tick7"), "new/one.svg");
  EXPECT_EQ(figure_file("new/one", "steps", "_tick7"), "new/one_tick7.png");
  EXPECT_EQ(figure_file("new/", "steps", "_tick7", PictureFormat::svg), "new/steps_tick7.svg");
}

TEST(Figures, NamesFollowAFolderOrAPrefix) {
  const std::string folder = ::testing::TempDir();
  EXPECT_EQ(figure_files(folder, "run").force, std::filesystem::path(folder) / "run_force.png");
  EXPECT_EQ(figure_files("new/folder/", "run").path, "new/folder/run_path.png");
  EXPECT_EQ(figure_files("new/ears", "run").path, "new/ears_path.png");
  EXPECT_EQ(figure_files("new/ears", "run").against, "new/ears_against.png");
}

}  // namespace
}  // namespace tactus::host
