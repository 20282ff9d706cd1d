// Running models on motions and pushes, against solutions that this project did not compute.
#include "host_tools/friction/friction_run.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/csv.h"
#include "tests/unit/host_tools/bake/temporary_folder.h"
#include "tests/unit/rendering/friction/published.h"

namespace tactus::host {
namespace {

using rendering::FrictionKind;
using testing::contains;
using testing::Csv;
using testing::input_error;
using testing::published;
using testing::TemporaryFolder;

// Behind `before`.
TimeSeries column(const Csv& csv, const std::string& name, TimeSeries before = {}) {
  TimeSeries series = std::move(before);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    series.t_s.push_back(csv.number(row, "t_s"));
    series.value.push_back(csv.number(row, name));
  }
  return series;
}

TEST(FrictionRun, AMotionGivesTheExactDiscretisationRowByRow) {
  const Csv csv("lugre_discretisation_A0.1_fs1000.csv");
  const TimeSeries motion = column(csv, "x_m", {.t_s = {0.0}, .value = {0.0}});
  const FrictionTrack track = run_motion({.friction = published(FrictionKind::lugre)}, motion);
  ASSERT_EQ(track.samples.size(), csv.rows() + 1);
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    const FrictionSample& sample = track.samples[row + 1];
    EXPECT_EQ(sample.x_m, csv.number(row, "x_m"));
    EXPECT_NEAR(sample.bristle_m, csv.number(row, "z_exact_zoh_v_m"), 1e-12) << row;
    // The file's positions have 12 digits, of which the damping takes differences.
    EXPECT_NEAR(sample.force_N, csv.number(row, "F_exact_zoh_v_N"), 1e-6) << row;
  }
}

TEST(FrictionRun, DahlsLoopIsTheClosedFormAtAnySpeed) {
  const Csv csv("dahl_loop_A20um.csv");
  auto dahl = published(FrictionKind::dahl);
  dahl.viscous_s_per_m = 0.0;
  TimeSeries motion{.t_s = {0.0}, .value = {csv.number(csv.rows() - 1, "x_m")}};
  constexpr int kLoops = 5;  // until it is steady
  for (int loop = 0; loop < kLoops; ++loop) {
    for (std::size_t row = 0; row < csv.rows(); ++row) {
      motion.t_s.push_back(motion.t_s.back() + 1e-3);
      motion.value.push_back(csv.number(row, "x_m"));
    }
  }
  const FrictionTrack track = run_motion({.friction = dahl}, motion);
  const std::size_t begin = track.samples.size() - csv.rows();
  for (std::size_t row = 0; row < csv.rows(); ++row) {
    EXPECT_NEAR(track.samples[begin + row].force_N, csv.number(row, "F_N"), 1e-9) << row;
  }
}

TEST(FrictionRun, APushedMassFollowsThePublishedPreslidingAtBothRates) {
  const Csv csv("lugre_presliding_fig2.csv");
  const TimeSeries push = column(csv, "u_applied_N");
  for (const double rate_hz : {1000.0, 4000.0}) {
    const FrictionTrack track =
        run_push({.friction = published(FrictionKind::lugre), .rate_hz = rate_hz}, push);
    TimeSeries x;
    for (const FrictionSample& sample : track.samples) {
      x.t_s.push_back(sample.t_s);
      x.value.push_back(sample.x_m);
    }
    for (std::size_t row = 0; row < csv.rows(); ++row) {
      EXPECT_NEAR(x.at(csv.number(row, "t_s")), csv.number(row, "x_m"), 0.01 * 45e-6)
          << row << " at " << rate_hz;
    }
    EXPECT_EQ(track.column("push_N")->values.size(), track.samples.size());
  }
}

TEST(FrictionRun, CoulombStopsASlidingMassWhereTheClosedFormSays) {
  // Pushed with 2 N until 0.5 m/s (m = 1 kg, Fc = 1 N, from rest: 1 m/s^2), then left alone.
  auto coulomb = published(FrictionKind::coulomb_viscous);
  coulomb.viscous_s_per_m = 0.0;
  coulomb.stiffness_N_per_m = 0.0;
  const TimeSeries push{.t_s = {0.0, 0.5, 0.5 + 1e-9, 2.0}, .value = {2.0, 2.0, 0.0, 0.0}};
  const FrictionTrack track = run_push({.friction = coulomb, .rate_hz = 1000.0}, push);
  EXPECT_NEAR(track.samples.back().x_m, 0.125 + 0.125, 1e-6);
  EXPECT_EQ(track.samples.back().v_m_per_s, 0.0);
}

TEST(FrictionRun, TheNormalForceScalesTheLevelsAndNotTheStiffness) {
  const TimeSeries motion{.t_s = {0.0, 1.0, 2.0}, .value = {0.0, 1e-9, 1.0}};
  auto dahl = published(FrictionKind::dahl);
  dahl.viscous_s_per_m = 0.0;
  const FrictionTrack track = run_motion({.friction = dahl, .normal_force_N = 3.0}, motion);
  EXPECT_NEAR(track.samples[1].force_N, 1e-4, 1e-8);
  EXPECT_NEAR(track.samples[2].force_N, 3.0, 1e-12);
}

TEST(FrictionRun, ResamplingFollowsStraightLines) {
  const TimeSeries series{.t_s = {1.0, 1.5, 2.0}, .value = {0.0, 1.0, 0.0}};
  const TimeSeries fine = resampled(series, 4.0);
  EXPECT_EQ(fine.t_s, (std::vector<double>{1.0, 1.25, 1.5, 1.75, 2.0}));
  EXPECT_EQ(fine.value, (std::vector<double>{0.0, 0.5, 1.0, 0.5, 0.0}));
}

TEST(FrictionRun, WhatIsWrittenIsWhatWasComputed) {
  const TemporaryFolder folder;
  const TimeSeries push{.t_s = {0.0, 0.1}, .value = {0.0, 1.0}};
  const FrictionTrack track = run_push({.friction = published(FrictionKind::lugre)}, push);
  write_track(folder.path() / "out.csv", track);
  const TimeSeries force = read_time_series(folder.path() / "out.csv", "force_N");
  ASSERT_EQ(force.value.size(), track.samples.size());
  for (std::size_t k = 0; k < force.value.size(); ++k) {
    EXPECT_EQ(force.t_s[k], track.samples[k].t_s);
    EXPECT_EQ(force.value[k], track.samples[k].force_N);
  }
}

TEST(FrictionRun, BadFilesAreRefusedWithFileLineAndColumn) {
  const TemporaryFolder folder;
  const auto complaint = [&folder](std::string_view text) {
    const std::filesystem::path file = folder.write("in.csv", text);
    const std::string message = input_error([&] { read_time_series(file, "x_m"); });
    return message.substr(message.find("in.csv"));
  };
  EXPECT_EQ(complaint("t_s,x_m\n0,0\n1,1\n1,2\n"),
            "in.csv:4: column t_s: 1 does not come after 1; time must grow from row to row");
  EXPECT_EQ(complaint("t_s,x_m\n0,0\n"),
            "in.csv:2: one row is no course in time; give two or more");
  EXPECT_EQ(complaint("t_s,x_mm\n0,0\n"), "in.csv:1: no column x_m; the header is: t_s,x_mm");
  EXPECT_TRUE(contains(complaint("t_s,x_m\n0,0\n1,a\n"), "in.csv:3: column x_m: 'a' is not"));
}

}  // namespace
}  // namespace tactus::host
