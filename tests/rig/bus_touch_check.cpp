// Holds what the controller wrote down (tactusd --record) against what the emulated device really
// did (tactus emulate --truth): both carry CLOCK_MONOTONIC.
//   bus_touch_check touch RUN.csv TRUTH.csv JOINTS [LIMIT]
// It touched, knew where it was, pushed as it said.
//   bus_touch_check fault RUN.csv TRUTH.csv JOINTS LIMIT_MS
// It was stopped: torque is zero for good within LIMIT_MS of the last tick without fault.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "host_tools/csv/csv_table.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

struct Limits {
  double torque_share = 0.02;  // ticks whose torque is not what was commanded
  double least_force_N = 1.0;  // or it did not touch
};

// Of encoder, transport and the millisecond between two truths, rad or m.
constexpr double kJointLimit = 2e-4;

bool failed = false;

void expect(bool holds, const std::string& what) {
  fmt::print("{}: {}\n", holds ? "measured" : "FAILED", what);
  failed = failed || !holds;
}

class Comparison {
 public:
  Comparison(const std::string& run, const std::string& truth, std::size_t joints)
      : joints_(joints), run_(read(run, run_columns())), truth_(read(truth, truth_columns())) {
    for (std::size_t joint = 0; joint < joints; ++joint) {
      seen_.push_back(run_.column(fmt::format("joint{}", joint + 1)));
      commanded_Nm_.push_back(run_.column(fmt::format("torque{}_Nm", joint + 1)));
      position_.push_back(truth_.column(fmt::format("joint_{}", joint)));
      torque_Nm_.push_back(truth_.column(fmt::format("shaft_{}_torque_Nm", joint)));
    }
  }

  void check_touch(double joint_limit) const {
    const auto faults = run_.column("faults");
    expect(std::ranges::all_of(faults, [](double bits) { return bits == 0.0; }), "no fault");
    check_joints(joint_limit);
    check_torques();
    check_force();
  }

  void check_fault(double limit_ms) const {
    const auto faults = run_.column("faults");
    const auto first = std::ranges::find_if(faults, [](double bits) { return bits != 0.0; });
    expect(first != faults.end(), "the controller latched a fault");
    const auto done = run_.column("done_ns");
    const std::size_t row = static_cast<std::size_t>(first - faults.begin());
    if (first == faults.end() || row == 0) {
      return;
    }
    double last_torque_ns = 0.0;
    for (std::size_t i = 0; i < truth_.rows(); ++i) {
      if (torque_at(i) != 0.0) {
        last_torque_ns = truth_.column("t_ns")[i];
      }
    }
    expect(last_torque_ns > 0.0, "there was torque before");
    const double late_ms = (last_torque_ns - done[row - 1]) * 1e-6;
    expect(late_ms <= limit_ms,
           fmt::format("the last torque came {:.2f} ms after the last good tick, "
                       "{} ms allowed",
                       late_ms, limit_ms));
  }

 private:
  static CsvTable read(const std::string& file, const std::vector<std::string>& names) {
    const std::vector<std::string_view> views(names.begin(), names.end());
    return CsvTable::read(file, views);
  }

  [[nodiscard]] std::vector<std::string> run_columns() const {
    std::vector<std::string> names{"done_ns",   "sample_ns", "faults",   "contact",
                                   "force_x_N", "force_y_N", "force_z_N"};
    for (std::size_t i = 1; i <= joints_; ++i) {
      names.push_back(fmt::format("joint{}", i));
      names.push_back(fmt::format("torque{}_Nm", i));
    }
    return names;
  }
  [[nodiscard]] std::vector<std::string> truth_columns() const {
    std::vector<std::string> names{"t_ns"};
    for (std::size_t i = 0; i < joints_; ++i) {
      names.push_back(fmt::format("joint_{}", i));
      names.push_back(fmt::format("shaft_{}_torque_Nm", i));
    }
    return names;
  }

  [[nodiscard]] double torque_at(std::size_t row) const {
    double sum = 0.0;
    for (const std::span<const double> torque_Nm : torque_Nm_) {
      sum += std::abs(torque_Nm[row]);
    }
    return sum;
  }

  // The truth between its two rows about a time, linearly; NaN outside.
  [[nodiscard]] double truth_between(std::span<const double> values, double t_ns) const {
    const auto times = truth_.column("t_ns");
    const auto after = std::ranges::lower_bound(times, t_ns);
    if (after == times.begin() || after == times.end()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (t_ns - times[i - 1]) / (times[i] - times[i - 1]);
    return values[i - 1] + share * (values[i] - values[i - 1]);
  }

  void check_joints(double limit) const {
    const auto times = run_.column("sample_ns");
    double worst = 0.0;
    for (std::size_t joint = 0; joint < joints_; ++joint) {
      for (std::size_t row = run_.rows() / 10; row < run_.rows(); ++row) {
        const double truth = truth_between(position_[joint], times[row]);
        if (std::isfinite(truth)) {
          worst = std::max(worst, std::abs(seen_[joint][row] - truth));
        }
      }
    }
    expect(worst <= limit,
           fmt::format("joints are at most {:.2e} (rad or m) from where they really are", worst));
  }

  // What the motors did at a truth's time against what had been commanded by then.
  void check_torques() const {
    const auto done = run_.column("done_ns");
    const auto times = truth_.column("t_ns");
    std::size_t compared = 0;
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < truth_.rows(); ++i) {
      const auto after = std::ranges::upper_bound(done, times[i]);
      if (after == done.begin() || after == done.end()) {
        continue;
      }
      const auto row = static_cast<std::size_t>(after - done.begin()) - 1;
      // The newest command or the one before, which may still be on its way.
      bool agrees = false;
      for (const std::size_t candidate : {row, row == 0 ? row : row - 1}) {
        agrees = agrees || torques_agree(candidate, i);
      }
      ++compared;
      wrong += agrees ? 0U : 1U;
    }
    const double share =
        static_cast<double>(wrong) / static_cast<double>(std::max<std::size_t>(1, compared));
    expect(compared > 100 && share <= kLimits.torque_share,
           fmt::format("torques at the shafts are the commanded ones in {:.2f} % of {} ms",
                       100.0 * (1.0 - share), compared));
  }

  [[nodiscard]] bool torques_agree(std::size_t row, std::size_t truth_row) const {
    for (std::size_t joint = 0; joint < joints_; ++joint) {
      const double commanded = commanded_Nm_[joint][row];
      const double real = torque_Nm_[joint][truth_row];
      if (std::abs(commanded - real) > kTorqueStep_Nm) {
        return false;
      }
    }
    return true;
  }

  void check_force() const {
    double most = 0.0;
    for (std::size_t row = 0; row < run_.rows(); ++row) {
      most = std::max(most, std::hypot(run_.column("force_x_N")[row], run_.column("force_y_N")[row],
                                       run_.column("force_z_N")[row]));
    }
    expect(most >= kLimits.least_force_N, fmt::format("the largest force was {:.2f} N", most));
    const auto contact = run_.column("contact");
    const auto ticks = std::ranges::count(contact, 1.0);
    expect(ticks > 100, fmt::format("in contact in {} of {} ticks", ticks, run_.rows()));
  }

  static constexpr Limits kLimits{};
  static constexpr double kTorqueStep_Nm = 1e-3;  // the coarsest drive: 0.1 % of its rated torque

  std::size_t joints_;
  CsvTable run_;
  CsvTable truth_;
  // By joint: of the run, then of the truth.
  std::vector<std::span<const double>> seen_;
  std::vector<std::span<const double>> commanded_Nm_;
  std::vector<std::span<const double>> position_;
  std::vector<std::span<const double>> torque_Nm_;
};

int check(std::span<char*> arguments) {
  if (arguments.size() < 5) {
    fmt::print(stderr, "usage: bus_touch_check touch|fault RUN.csv TRUTH.csv JOINTS [LIMIT]\n");
    return 2;
  }
  const Comparison comparison(arguments[2], arguments[3],
                              static_cast<std::size_t>(std::atoi(arguments[4])));
  if (std::string_view(arguments[1]) == "touch") {
    comparison.check_touch(arguments.size() > 5 ? std::atof(arguments[5]) : kJointLimit);
  } else {
    comparison.check_fault(arguments.size() > 5 ? std::atof(arguments[5]) : 5.0);
  }
  return failed ? 1 : 0;
}

}  // namespace
}  // namespace tactus::host

int main(int argc, char** argv) {
  try {
    return tactus::host::check({argv, static_cast<std::size_t>(argc)});
  } catch (const tactus::host::InputError& error) {
    fmt::print(stderr, "bus_touch_check: {}\n", error.what());
    return 2;
  }
}
