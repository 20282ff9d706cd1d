#include "host_tools/friction/fit_record.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>

#include "tests/unit/host_tools/bake/temporary_folder.h"

namespace tactus::host {
namespace {

using testing::contains;
using testing::input_error;
using testing::TemporaryFolder;

// A swing of 10 mm and 1 N against it. `row` writes what stands behind t_s.
template <class Row>
std::string table(const std::string& header, Row row) {
  std::string text = header + "\n";
  for (int k = 0; k < 1000; ++k) {
    const double t = 1e-2 * k;
    fmt::format_to(std::back_inserter(text), "{},{}\n", t, row(t));
  }
  return text;
}

double place(double t) {
  return 0.01 * std::sin(t);
}
double velocity(double t) {
  return 0.01 * std::cos(t);
}
double force(double t) {
  return std::copysign(1.0, velocity(t));
}

class FrictionRecordFile : public ::testing::Test {
 protected:
  FrictionRecord read(const std::string& text, std::optional<double> normal_force_N = {}) {
    return read_friction_record(folder.write("data.csv", text), normal_force_N);
  }
  std::string complaint(const std::string& text) {
    const std::string message = input_error([&] { read(text); });
    return message.substr(message.find("data.csv"));
  }
  TemporaryFolder folder;
};

TEST_F(FrictionRecordFile, IsReadWithOneNewtonWhereNothingElseIsSaid) {
  const std::string text =
      table("t_s,x_m,force_N", [](double t) { return fmt::format("{},{}", place(t), force(t)); });
  const FrictionRecord record = read(text);
  EXPECT_EQ(record.rows(), 1000U);
  EXPECT_FALSE(record.has_normal_force);
  EXPECT_EQ(record.normal_force_N[7], 1.0);
  EXPECT_FALSE(record.uses_velocity);
  EXPECT_NEAR(record.speed_m_per_s(5), velocity(0.045), 1e-6);
  EXPECT_NEAR(record.level(5), 1.0, 1e-12);
  EXPECT_EQ(read(text, 2.0).normal_force_N[7], 2.0);
  EXPECT_NEAR(read(text, 2.0).level(5), 0.5, 1e-12);
  const RecordTraits traits = traits_of(record);
  EXPECT_EQ(traits.reversals, 3U);
  EXPECT_NEAR(traits.fastest_m_per_s, 0.01, 1e-5);
  EXPECT_FALSE(traits.is_rough);
}

TEST_F(FrictionRecordFile, AColumnOfTheNormalForceIsTaken) {
  const FrictionRecord record = read(table("t_s,x_m,force_N,normal_force_N", [](double t) {
    return fmt::format("{},{},4", place(t), force(t));
  }));
  EXPECT_TRUE(record.has_normal_force);
  EXPECT_EQ(record.normal_force_N[7], 4.0);
}

TEST_F(FrictionRecordFile, TheVelocityReplacesAPositionInCoarseSteps) {
  const auto row = [](double t) {
    return fmt::format("{},{},{}", 1e-3 * std::round(1e3 * place(t)), force(t), velocity(t));
  };
  const FrictionRecord record = read(table("t_s,x_m,force_N,v_m_per_s", row));
  EXPECT_TRUE(record.uses_velocity);
  EXPECT_NEAR(record.speed_m_per_s(5), velocity(0.045), 1e-6);
  const FrictionRecord without = read(table("t_s,x_m,force_N,v", row));
  EXPECT_TRUE(traits_of(without).is_rough);
}

TEST_F(FrictionRecordFile, WhatIsNoFrictionIsRefused) {
  EXPECT_TRUE(contains(complaint("t_s,x_m,force_N\n0,0,1\n"), "data.csv: 1 rows; a fit needs"));
  EXPECT_TRUE(contains(complaint(table("t_s,x_m,force_N", [](double) { return "1,1"; })),
                       "data.csv: x_m never changes"));
  EXPECT_TRUE(
      contains(complaint(table("t_s,x_m,force_N", [](double t) { return fmt::format("{},0", t); })),
               "data.csv: force_N is 0 wherever x_m changes"));
  EXPECT_TRUE(
      contains(complaint(table("t_s,x_m,force_N",
                               [](double t) { return fmt::format("{},{}", place(t), -force(t)); })),
               "turn the sign of force_N"));
  EXPECT_TRUE(contains(complaint(table("t_s,x_m,force_N,v_m_per_s",
                                       [](double t) {
                                         return fmt::format("{},{},{}", 1e3 * place(t), force(t),
                                                            velocity(t));
                                       })),
                       "are both in metres and seconds?"));
  EXPECT_TRUE(contains(complaint("t_s,x_m,force_N\n0,0,1\n1,1,1\n1,2,1\n"),
                       "data.csv:4: column t_s: 1 does not come after 1"));
  EXPECT_TRUE(contains(complaint("t_s,x_m,force_N\n0,0,1 N\n"),
                       "data.csv:2: column force_N: '1 N' is not a finite number"));
}

}  // namespace
}  // namespace tactus::host
