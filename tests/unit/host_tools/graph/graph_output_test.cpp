// `tactus inspect --graph`: what it prints and writes is read back and counted.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <regex>
#include <sstream>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "host_tools/graph/label_places.h"
#include "host_tools/graph/line_visibility.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/png_size.h"
#include "tests/support/run_program.h"

namespace tactus::host {
namespace {

class GraphOutput : public FolderTest {
 protected:
  [[nodiscard]] testing::Outcome inspect(const std::string& arguments) const {
    return testing::run_program(folder(), "inspect --graph " + arguments);
  }
  static std::string notch() {
    return "'" + testing::in_repository("host_tools/examples/notch/notch.off") + "'";
  }
  void bake(const std::string& example) const {
    const std::string scene = testing::in_repository("host_tools/examples/" + example);
    ASSERT_EQ(
        testing::run_program(folder(), "bake '" + scene + "/scene.toml' -o scene.tactus").exit_code,
        0);
  }
};

// Counts the values of a key of all elements.
std::map<std::string, int> tally(const nlohmann::json& elements, const char* key) {
  std::map<std::string, int> counts;
  for (const nlohmann::json& element : elements) {
    ++counts[element[key]];
  }
  return counts;
}

TEST_F(GraphOutput, TextCountsTheTypes) {
  const std::string text = inspect(notch()).output;
  for (const char* line :
       {"nodes         24 in 9 flat faces", "connections   36: 18 convex, 3 concave, 15 flat",
        "corners       14: 10 convex, 1 concave, 3 partly convex",
        "Euler         2 = 14 corners - 36 connections + 24 nodes", "--json lists all"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
  }
}

TEST_F(GraphOutput, JsonHasEveryFeatureAndTheSameCounts) {
  const testing::Outcome outcome = inspect(notch() + " --json");
  const nlohmann::json json = nlohmann::json::parse(outcome.output);
  const nlohmann::json& mesh = json["meshes"][0];
  EXPECT_EQ(mesh["nodes"].size(), 24U);
  EXPECT_EQ(tally(mesh["connections"], "type"),
            (std::map<std::string, int>{{"convex", 18}, {"concave", 3}, {"flat", 15}}));
  EXPECT_EQ(tally(mesh["corners"], "type"),
            (std::map<std::string, int>{{"convex", 10}, {"concave", 1}, {"partly convex", 3}}));
  // Connections and nodes name each other, and corners and connections.
  for (std::size_t i = 0; i < mesh["connections"].size(); ++i) {
    const nlohmann::json& connection = mesh["connections"][i];
    for (const nlohmann::json& side : connection["connected_nodes"]) {
      EXPECT_EQ(mesh["nodes"][side["node"].get<std::size_t>()]["connections"]
                    [side["edge"].get<std::size_t>()],
                i);
      EXPECT_EQ(side["voronoi_plane"]["normal"].size(), 3U);
    }
    for (const nlohmann::json& corner : connection["shared_vertices"]) {
      const nlohmann::json& known = mesh["corners"][corner.get<std::size_t>()]["connections"];
      EXPECT_NE(std::ranges::find(known, nlohmann::json(i)), known.end());
    }
    EXPECT_EQ(connection["end_planes"].size(), 2U);
  }
}

TEST_F(GraphOutput, DotHasANodeForEachFeatureAndAnArrowForEachIncidence) {
  ASSERT_EQ(inspect(notch() + " --dot graph.dot").exit_code, 0);
  std::istringstream lines(read_file(file("graph.dot")));
  const std::regex node(
      R"dot(  ([fev])(\d+) \[label="[FEV]\2", class="(face|edge|vertex)"(, \w+=("[^"]*"|\w+))+\];)dot");
  const std::regex arrow(R"(  ([fe])\d+ -> ([ev])\d+;)");
  std::map<std::string, int> nodes;
  std::map<std::string, int> arrows;
  int others = 0;
  for (std::string line; std::getline(lines, line);) {
    std::smatch match;
    if (std::regex_match(line, match, node)) {
      ++nodes[match[1]];
    } else if (std::regex_match(line, match, arrow)) {
      ++arrows[match[1].str() + match[2].str()];
    } else {
      ++others;
    }
  }
  EXPECT_EQ(nodes, (std::map<std::string, int>{{"f", 24}, {"e", 36}, {"v", 14}}));
  EXPECT_EQ(arrows, (std::map<std::string, int>{{"fe", 72}, {"ev", 72}}));
  EXPECT_EQ(others, 5);  // digraph, three defaults and the closing brace
}

TEST_F(GraphOutput, PictureIsDrawnOfMeshFilesAndScenes) {
  EXPECT_EQ(inspect(notch() + " --picture file.png").exit_code, 0);
  EXPECT_EQ(testing::png_size(file("file.png")).width, 1800U);
  bake("gem");
  const testing::Outcome outcome = inspect("scene.tactus --picture scene.png --dot scene.dot");
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(testing::png_size(file("scene.png")).width, 1800U);
  EXPECT_NE(read_file(file("scene.dot")).find("  m2_e29 [label=\"E29\""), std::string::npos);
}

TEST_F(GraphOutput, KeepsTheShapeOfAMeshAtTheCoordinatesOfAMap) {
  std::ifstream plain(testing::in_repository("host_tools/examples/notch/notch.off"));
  std::ofstream moved(file("map.off"));
  std::string line;
  for (int number = 0; std::getline(plain, line); ++number) {
    std::istringstream words(line);
    double x = 0.0;
    double y = 0.0;
    double z = 0.0;
    if (number < 2 || number >= 16) {
      moved << line << '\n';
    } else if (words >> x >> y >> z) {
      moved << std::setprecision(12) << x + 480000.0 << ' ' << y + 5400000.0 << ' ' << z << '\n';
    }
  }
  moved.close();
  const std::string text = inspect("map.off").output;
  EXPECT_NE(text.find("36: 18 convex, 3 concave, 15 flat"), std::string::npos) << text;
  EXPECT_NE(text.find("positions are from (479999.985, "), std::string::npos) << text;
}

TEST_F(GraphOutput, LeavesOutWhatIsNoMesh) {
  bake("primitives");
  EXPECT_NE(inspect("scene.tactus").output.find("only meshes have a connection graph"),
            std::string::npos);
  bake("heart");
  const testing::Outcome heart = inspect("scene.tactus");
  EXPECT_EQ(heart.exit_code, 2);
  EXPECT_NE(heart.output.find("only meshes have a connection graph"), std::string::npos);
}

TEST_F(GraphOutput, RefusesBadInputAndUnsafeOutputs) {
  EXPECT_EQ(inspect("missing.off").exit_code, 2);
  bake("gem");
  EXPECT_EQ(inspect("scene.tactus --dot scene.tactus").exit_code, 2);
  EXPECT_EQ(inspect("scene.tactus --dot a --picture a").exit_code, 2);
  EXPECT_EQ(testing::run_program(folder(), "inspect scene.tactus --dot graph.dot").exit_code, 2);
  EXPECT_EQ(testing::run_program(folder(), "inspect " + notch()).exit_code, 2);
}

TEST(LineVisibility, HidesWhatIsBehindAndNothingElse) {
  LineVisibility visibility(
      {.lower = {.right = -2, .up = -2}, .upper = {.right = 2, .up = 2}, .empty = false}, 400);
  const std::vector<rendering::Float3> square = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<rendering::TriangleIndices> triangles = {{0, 1, 2}, {0, 2, 3}};
  visibility.add(square, triangles);
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> in(-1.9, 1.9);
  for (int i = 0; i < 2000; ++i) {
    const double x = in(random);
    const double y = in(random);
    const Vec3 p(x, y, in(random));
    const double inside = 1.0 - std::max(std::abs(x), std::abs(y));
    if (std::abs(inside) > 0.025 && std::abs(p.z()) > 0.02) {
      EXPECT_EQ(visibility.hides(p), inside > 0.0 && p.z() < 0.0) << p.transpose();
    }
  }
  const auto parts = visibility.visible_parts({-1.8, 0.1, -1}, {1.8, 0.1, -1});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(parts[0].second.x(), -1.0, 0.05);
  EXPECT_NEAR(parts[1].first.x(), 1.0, 0.05);
  EXPECT_EQ(visibility.visible_parts({-1.8, 0.1, 0}, {1.8, 0.1, 0}).size(), 1U);
}

TEST(LabelPlaces, PrintsNothingOverAnother) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> in(0.0, 300.0);
  const auto somewhere = [&] {
    const double right = in(random);
    return PlanePoint{.right = right, .up = in(random)};
  };
  LabelPlaces places;
  std::vector<PixelLine> lines;
  for (int i = 0; i < 8; ++i) {
    const PlanePoint from = somewhere();
    lines.emplace_back(from, somewhere());
    places.keep_off(lines.back());
  }
  std::vector<PlanePoint> labels;
  for (int i = 0; i < 60; ++i) {
    if (const auto middle = places.take_beside(somewhere(), 20.0, 10.0)) {
      labels.push_back(*middle);
    }
  }
  EXPECT_GT(labels.size(), 20U);
  const auto covers = [](const PlanePoint& label, const PlanePoint& p, double size) {
    return std::abs(label.right - p.right) < 10.0 * size - 1e-9 &&
           std::abs(label.up - p.up) < 5.0 * size - 1e-9;
  };
  for (std::size_t i = 0; i < labels.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_FALSE(covers(labels[i], labels[j], 2.0));
    }
    for (const PixelLine& line : lines) {
      for (double t = 0.0; t <= 1.0; t += 1e-3) {
        const PlanePoint p{.right = line.first.right + t * (line.second.right - line.first.right),
                           .up = line.first.up + t * (line.second.up - line.first.up)};
        EXPECT_FALSE(covers(labels[i], p, 1.0));
      }
    }
  }
}

}  // namespace
}  // namespace tactus::host
