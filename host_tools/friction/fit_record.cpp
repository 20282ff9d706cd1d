#include "host_tools/friction/fit_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <span>
#include <string_view>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::array<std::string_view, 3> kNeeded{"t_s", "x_m", "force_N"};
constexpr std::array<std::string_view, 2> kOptional{"v_m_per_s", "normal_force_N"};

std::vector<double> copy(std::span<const double> values) {
  return {values.begin(), values.end()};
}

// Returns the roughness of the ticks' velocities, m/s: the root mean square of their second
// differences.
double roughness(const std::vector<double>& displacement_m, const std::vector<double>& step_s) {
  double sum = 0.0;
  for (std::size_t k = 3; k < step_s.size(); ++k) {
    const double second = displacement_m[k] / step_s[k] -
                          2.0 * displacement_m[k - 1] / step_s[k - 1] +
                          displacement_m[k - 2] / step_s[k - 2];
    sum += second * second;
  }
  return std::sqrt(sum / static_cast<double>(step_s.size()));
}

double rms_velocity(const std::vector<double>& displacement_m, const std::vector<double>& step_s) {
  double sum = 0.0;
  for (std::size_t k = 1; k < step_s.size(); ++k) {
    sum += std::pow(displacement_m[k] / step_s[k], 2);
  }
  return std::sqrt(sum / static_cast<double>(step_s.size()));
}

double travel(const std::vector<double>& displacement_m) {
  return std::transform_reduce(displacement_m.begin(), displacement_m.end(), 0.0, std::plus<>(),
                               [](double d) { return std::fabs(d); });
}

// Returns how far the motion goes, between its lowest and highest place, m.
double range_of(const std::vector<double>& displacement_m) {
  double place = 0.0;
  double low = 0.0;
  double high = 0.0;
  for (const double d : displacement_m) {
    place += d;
    low = std::min(low, place);
    high = std::max(high, place);
  }
  return high - low;
}

// Replaces the displacements by the integral of the velocity if that is clearly smoother. Throws
// InputError if the two do not fit each other, as with mixed units.
void take_velocity(FrictionRecord& record, std::span<const double> v, const std::string& file) {
  std::vector<double> from_v(record.rows(), 0.0);
  for (std::size_t k = 1; k < record.rows(); ++k) {
    from_v[k] = 0.5 * (v[k] + v[k - 1]) * record.step_s[k];
  }
  constexpr double kTooFar = 3.0;
  const double by_x = range_of(record.displacement_m);
  const double by_v = range_of(from_v);
  if (by_v > kTooFar * by_x || by_x > kTooFar * by_v) {
    throw InputError(
        fmt::format("{}: x_m moves over {:.3g} m, but v_m_per_s makes that {:.3g} m; are both in "
                    "metres and seconds?",
                    file, by_x, by_v));
  }
  // A velocity that was computed from x_m by differences is as rough as x_m.
  constexpr double kClearly = 3.0;
  if (roughness(record.displacement_m, record.step_s) >
      kClearly * roughness(from_v, record.step_s)) {
    record.displacement_m = std::move(from_v);
    record.uses_velocity = true;
  }
}

// Throws InputError if nothing moves, nothing resists, or the force feeds energy into the motion.
void refuse_what_no_friction_is(const FrictionRecord& record, const std::string& file) {
  if (!(travel(record.displacement_m) > 0.0)) {
    throw InputError(fmt::format("{}: x_m never changes; friction shows only in motion", file));
  }
  double work_J = 0.0;
  double size_J = 0.0;
  for (std::size_t k = 1; k < record.rows(); ++k) {
    const double power = 0.5 * (record.force_N[k] + record.force_N[k - 1]);
    work_J += power * record.displacement_m[k];
    size_J += std::fabs(power * record.displacement_m[k]);
  }
  if (!(size_J > 0.0)) {
    throw InputError(fmt::format("{}: force_N is 0 wherever x_m changes", file));
  }
  // Noise and presliding give back some energy; more than a fifth means that the sign is wrong.
  constexpr double kDriven = -0.2;
  if (work_J < kDriven * size_J) {
    throw InputError(
        fmt::format("{}: force_N drives the motion, it takes {:.3g} J in all; friction gives no "
                    "energy: turn the sign of force_N, which points along the motion",
                    file, work_J));
  }
}

void refuse_time_that_stands(const CsvTable& table, const std::string& file) {
  const auto t = table.column("t_s");
  for (std::size_t row = 1; row < table.rows(); ++row) {
    if (t[row] <= t[row - 1]) {
      throw InputError(fmt::format(
          "{}:{}: column t_s: {} does not come after {}; time must grow from row to row", file,
          table.line(row), t[row], t[row - 1]));
    }
  }
}

// Returns the value below which the share of the values lies; 0 without values.
double quantile(std::vector<double> values, double share) {
  if (values.empty()) {
    return 0.0;
  }
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return *at;
}

}  // namespace

double FrictionRecord::speed_m_per_s(std::size_t row) const {
  return std::fabs(displacement_m[row]) / step_s[row];
}

bool FrictionRecord::is_at_reversal(std::size_t row) const {
  const auto turns = [this](std::size_t k) {
    return k >= 1 && k < rows() && displacement_m[k - 1] * displacement_m[k] < 0.0;
  };
  return turns(row) || turns(row + 1);
}

double FrictionRecord::level(std::size_t row) const {
  if (!(normal_force_N[row] > 0.0)) {
    return 0.0;
  }
  return std::copysign(1.0, displacement_m[row]) * force_N[row] / normal_force_N[row];
}

FrictionRecord read_friction_record(const std::filesystem::path& file,
                                    std::optional<double> normal_force_N) {
  constexpr std::size_t kLeastRows = 20;
  const CsvTable table = CsvTable::read(file, kNeeded, kOptional);
  const std::string name = file.string();
  refuse_time_that_stands(table, name);
  if (table.rows() < kLeastRows) {
    throw InputError(
        fmt::format("{}: {} rows; a fit needs at least {}", name, table.rows(), kLeastRows));
  }
  FrictionRecord record{.t_s = copy(table.column("t_s")),
                        .x_m = copy(table.column("x_m")),
                        .force_N = copy(table.column("force_N")),
                        .normal_force_N = copy(table.column("normal_force_N")),
                        .has_normal_force = normal_force_N || table.has("normal_force_N")};
  if (normal_force_N || !table.has("normal_force_N")) {
    record.normal_force_N.assign(table.rows(), normal_force_N.value_or(1.0));
  }
  record.step_s.assign(table.rows(), 0.0);
  record.displacement_m.assign(table.rows(), 0.0);
  for (std::size_t k = 1; k < table.rows(); ++k) {
    record.step_s[k] = record.t_s[k] - record.t_s[k - 1];
    record.displacement_m[k] = record.x_m[k] - record.x_m[k - 1];
  }
  if (table.has("v_m_per_s")) {
    take_velocity(record, table.column("v_m_per_s"), name);
  }
  refuse_what_no_friction_is(record, name);
  return record;
}

RecordTraits traits_of(const FrictionRecord& record) {
  constexpr double kMost = 0.9;
  constexpr double kFew = 0.05;
  // Below this share of the typical level the force has not arrived on the other side.
  constexpr double kOnTheWay = 0.6;
  constexpr double kRough = 0.5;
  RecordTraits traits;
  std::vector<double> levels;
  std::vector<double> speeds;
  std::vector<double> steps;
  for (std::size_t k = 1; k < record.rows(); ++k) {
    if (record.normal_force_N[k] > 0.0) {
      levels.push_back(std::fabs(record.level(k)));
    }
    if (record.displacement_m[k] != 0.0) {
      speeds.push_back(record.speed_m_per_s(k));
      steps.push_back(std::fabs(record.displacement_m[k]));
    }
  }
  traits.typical_level = quantile(levels, kMost);
  traits.slowest_m_per_s = quantile(speeds, kFew);
  traits.fastest_m_per_s = *std::ranges::max_element(speeds);
  traits.small_step_m = quantile(steps, kFew);
  traits.travel_m = travel(record.displacement_m);
  traits.is_rough = roughness(record.displacement_m, record.step_s) >
                    kRough * rms_velocity(record.displacement_m, record.step_s);
  double direction = 0.0;
  bool on_the_way = true;  // until the force has arrived
  for (std::size_t k = 1; k < record.rows(); ++k) {
    if (record.displacement_m[k] != 0.0) {
      const double now = std::copysign(1.0, record.displacement_m[k]);
      if (direction * now < 0.0) {
        ++traits.reversals;
        on_the_way = true;
      }
      direction = now;
    }
    on_the_way = on_the_way && record.level(k) < kOnTheWay * traits.typical_level;
    traits.presliding_rows += on_the_way ? 1 : 0;
  }
  return traits;
}

}  // namespace tactus::host
