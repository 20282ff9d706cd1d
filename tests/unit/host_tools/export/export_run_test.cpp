// A table is held against what the controller's own CSV writer makes of the same ticks, JSON
// against an independent parser, and NPZ against numpy.
#include "host_tools/export/export_run.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "firmware/linux/telemetry/csv_writer.h"
#include "firmware/linux/telemetry/mcap_writer.h"
#include "host_tools/export/npz.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/record_columns.h"
#include "tests/support/folder_test.h"
#include "tests/support/paths.h"
#include "tests/support/run_program.h"
#include "tests/unit/firmware/linux/telemetry/random_tick.h"

namespace tactus::host {
namespace {

constexpr std::size_t kExportedJoints = 3;

class ExportRun : public FolderTest {
 protected:
  static firmware::RecordedTick tick(std::uint64_t number) {
    std::mt19937_64 random(number);
    firmware::RecordedTick tick = firmware::random_tick(random);
    tick.record.tick = number;
    tick.record.time_s = 1e-3 * static_cast<double>(number);
    tick.joint_count = kExportedJoints;
    return tick;
  }

  // Records so many ticks, and the same ticks as CSV by the controller's writer.
  void record(std::uint64_t ticks) const {
    constexpr std::array<firmware::MetadataEntry, 1> kInfo{{{"rate_hz", "1000"}}};
    const auto mcap = std::make_unique<firmware::McapWriter>();
    const auto csv = std::make_unique<firmware::CsvWriter>();
    ASSERT_EQ(mcap->open(file("run.mcap").c_str(), 0, kInfo), 0);
    ASSERT_EQ(csv->open(file("expected.csv").c_str(), kExportedJoints), 0);
    for (std::uint64_t i = 0; i < ticks; ++i) {
      mcap->add(tick(i));
      csv->add(tick(i));
      if (i == 1) {
        firmware::TelemetryEvent event{
            .tick = i, .kind = firmware::EventKind::parameter, .value = 300.5};
        set_name(event, "object.a \"b\", c.stiffness_N_per_m");
        mcap->add(event);
      }
    }
    ASSERT_EQ(mcap->close(), 0);
    ASSERT_EQ(csv->close(), 0);
  }

  [[nodiscard]] std::string text_of(const std::string& name) const {
    std::ifstream in(file(name));
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  [[nodiscard]] std::vector<std::string> lines_of(const std::string& name) const {
    std::vector<std::string> lines;
    std::ifstream in(file(name));
    for (std::string line; std::getline(in, line);) {
      lines.push_back(line);
    }
    return lines;
  }

  ExportSummary export_to(const std::string& name, const ExportChoice& choice = {}) const {
    Recording recording(file("run.mcap"));
    return export_ticks(recording, choice, export_format(name).value_or(ExportFormat::csv),
                        file(name), [](double) {});
  }
  [[nodiscard]] std::string complaint(const ExportChoice& choice) const {
    try {
      export_to("refused.csv", choice);
    } catch (const InputError& error) {
      return error.what();
    }
    return {};
  }
};

TEST_F(ExportRun, AsCsvIsWhatTheControllerWritesAsCsv) {
  record(300);
  const ExportSummary summary = export_to("run.csv");
  EXPECT_EQ(summary.ticks, 300U);
  EXPECT_EQ(summary.columns, column_names(kExportedJoints).size());
  EXPECT_DOUBLE_EQ(summary.last_s, 0.299);
  EXPECT_EQ(text_of("run.csv"), text_of("expected.csv"));
}

TEST_F(ExportRun, AsJsonHasTheSameNumbersByTheNamesOfTheColumns) {
  record(20);
  export_to("run.jsonl");
  const std::vector<std::string> lines = lines_of("run.jsonl");
  ASSERT_EQ(lines.size(), 20U);
  for (std::uint64_t i = 0; i < lines.size(); ++i) {
    const auto object = nlohmann::ordered_json::parse(lines[i]);
    const firmware::RecordedTick expected = tick(i);
    EXPECT_EQ(object.size(), column_names(kExportedJoints).size());
    EXPECT_EQ(object["tick"], i);
    EXPECT_EQ(object["mode"], firmware::mode_name(expected.record.mode));
    EXPECT_EQ(object["faults"], expected.record.faults);
    EXPECT_EQ(object["scheduled_ns"], expected.loop.scheduled_ns);
    if (std::isfinite(expected.record.tool_p_W[1])) {
      EXPECT_EQ(object["tool_y_m"].get<double>(), expected.record.tool_p_W[1]);
    }
    const auto hash = std::stoull(object["state_hash"].get<std::string>(), nullptr, 16);
    EXPECT_EQ(hash, expected.record.state_hash);
  }
}

TEST_F(ExportRun, ANumberThatIsNotFiniteIsNullInJson) {
  constexpr std::array<firmware::MetadataEntry, 1> kInfo{{{"rate_hz", "1000"}}};
  firmware::RecordedTick broken = tick(0);
  broken.record.depth_m = std::numeric_limits<double>::quiet_NaN();
  broken.record.passivity_J = -std::numeric_limits<double>::infinity();
  const auto mcap = std::make_unique<firmware::McapWriter>();
  ASSERT_EQ(mcap->open(file("run.mcap").c_str(), 0, kInfo), 0);
  mcap->add(broken);
  ASSERT_EQ(mcap->close(), 0);
  export_to("run.jsonl");
  const auto object = nlohmann::ordered_json::parse(text_of("run.jsonl"));
  EXPECT_TRUE(object["depth_m"].is_null());
  EXPECT_TRUE(object["passivity_J"].is_null());
  export_to("run.csv", {.fields = {"depth", "passivity"}});
  EXPECT_EQ(text_of("run.csv"), "depth_m,passivity_J\nnan,-inf\n");
}

TEST_F(ExportRun, AsNpzHasTheNumbersOfTheCsvToTheBit) {
  // Debian's numpy belongs to Debian's Python, whatever other Python comes first in the path.
  const std::string python = "/usr/bin/python3 ";
  if (testing::run_command(folder(), python + "-c 'import numpy'").exit_code != 0) {
    GTEST_SKIP() << "no numpy here: toolchains/install-packages.sh tests installs it";
  }
  record(300);
  const ExportSummary summary = export_to("run.npz");
  EXPECT_EQ(summary.ticks, 300U);
  EXPECT_EQ(summary.columns, column_names(kExportedJoints).size());
  const testing::Outcome compared = testing::run_command(
      folder(), "/usr/bin/python3 " +
                    testing::in_repository("tests/unit/host_tools/export/compare_npz.py") +
                    " run.npz expected.csv");
  EXPECT_EQ(compared.exit_code, 0) << compared.output;
  EXPECT_EQ(compared.output, std::to_string(summary.columns) + " arrays of 300\n");
}

TEST_F(ExportRun, AsNpzIsTheSameInOnePassAndInSeveral) {
  record(100);
  export_to("one_pass.npz");
  Recording recording(file("run.mcap"));
  write_npz(recording, {}, columns_of({}, kExportedJoints), file("passes.npz"), [](double) {},
            {.room_bytes = 10'000});
  EXPECT_EQ(text_of("passes.npz"), text_of("one_pass.npz"));
}

TEST_F(ExportRun, AsNpzGoesIntoAFileAlone) {
  record(10);
  EXPECT_EQ(testing::run_program(folder(), "export run.mcap -o run.npz --fields tick,force").output,
            "run.npz: 10 ticks of 4 columns, 0.000 to 0.009 s\n");
  const testing::Outcome piped =
      testing::run_program(folder(), "export run.mcap --format npz -o /dev/stdout");
  EXPECT_NE(piped.output.find("tactus export: /dev/stdout"), std::string::npos) << piped.output;
  const testing::Outcome events =
      testing::run_program(folder(), "export run.mcap -o b.npz --events events.npz");
  EXPECT_EQ(events.exit_code, 2);
  EXPECT_EQ(events.output,
            "tactus export: events.npz: events are written as .csv, .jsonl or .ndjson\n");
  EXPECT_FALSE(std::filesystem::exists(file("b.npz")));
}

TEST_F(ExportRun, WritesTheChosenColumnsOfTheChosenTicks) {
  record(100);
  const ExportSummary summary = export_to(
      "some.csv", {.fields = {"tick", "joint"}, .every = 10, .from_s = 0.0205, .to_s = 0.05});
  EXPECT_EQ(summary.ticks, 3U);
  const std::vector<std::string> lines = lines_of("some.csv");
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0], "tick,joint1,joint2,joint3");
  EXPECT_TRUE(lines[1].starts_with("21,")) << lines[1];
  EXPECT_TRUE(lines[3].starts_with("41,")) << lines[3];
}

TEST_F(ExportRun, RefusesWhatItCannotWriteAndLeavesTheFile) {
  record(10);
  std::ofstream(file("refused.csv")) << "mine";
  EXPECT_TRUE(
      complaint({.fields = {"forse"}}).starts_with("there is no field 'forse'; there are:"));
  EXPECT_EQ(complaint({.from_s = 5.0, .to_s = 6.0}),
            "the run has no tick from 5 s on up to 6 s; it ends at 0.009 s");
  EXPECT_EQ(text_of("refused.csv"), "mine");
}

TEST_F(ExportRun, WritesTheEvents) {
  record(10);
  const Recording recording(file("run.mcap"));
  EXPECT_EQ(export_events(recording, ExportFormat::csv, file("events.csv")), 1U);
  EXPECT_EQ(
      text_of("events.csv"),
      "tick,kind,name,value\n1,parameter,\"object.a \"\"b\"\", c.stiffness_N_per_m\",300.5\n");
  export_events(recording, ExportFormat::json_lines, file("events.jsonl"));
  const auto object = nlohmann::ordered_json::parse(text_of("events.jsonl"));
  EXPECT_EQ(object["name"], "object.a \"b\", c.stiffness_N_per_m");
  EXPECT_EQ(object["value"], 300.5);
}

TEST_F(ExportRun, TheProgramWritesBesideTheRecordingAndReplacesNothing) {
  record(50);
  const testing::Outcome written = testing::run_program(folder(), "export run.mcap");
  EXPECT_EQ(written.exit_code, 0) << written.output;
  EXPECT_TRUE(written.output.starts_with("run.csv: 50 ticks of ")) << written.output;
  EXPECT_EQ(text_of("run.csv"), text_of("expected.csv"));
  const testing::Outcome again = testing::run_program(folder(), "export run.mcap");
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_EQ(again.output,
            "tactus export: run.csv is there and is kept; name the output: -o run.csv\n");
  EXPECT_EQ(testing::run_program(folder(), "export run.mcap -o run.mcap").exit_code, 2);
  const testing::Outcome strange = testing::run_program(folder(), "export run.mcap -o run.txt");
  EXPECT_EQ(strange.exit_code, 2);
  EXPECT_NE(strange.output.find("say --format csv, jsonl or npz"), std::string::npos);
  const testing::Outcome piped =
      testing::run_program(folder(), "export run.mcap -o /dev/stdout --fields tick 2>/dev/null");
  EXPECT_TRUE(piped.output.starts_with("tick\n0\n1\n")) << piped.output;
}

// The same run, recorded in both forms.
TEST_F(ExportRun, OfASimulationIsWhatThatRecordsAsCsv) {
  std::ofstream(file("scene.toml")) << "[[object]]\nname = \"wall\"\nprimitive = \"plane\"\n";
  for (const std::string arguments :
       {"bake --quiet scene.toml -o scene.tactus", "sim scene.tactus --seconds 1 --record run.mcap",
        "sim scene.tactus --seconds 1 --record recorded.csv", "export run.mcap -o exported.csv"}) {
    const testing::Outcome outcome = testing::run_program(folder(), arguments);
    ASSERT_EQ(outcome.exit_code, 0) << arguments << "\n" << outcome.output;
  }
  EXPECT_EQ(lines_of("recorded.csv").size(), 1001U);
  EXPECT_EQ(text_of("exported.csv"), text_of("recorded.csv"));
}

}  // namespace
}  // namespace tactus::host
