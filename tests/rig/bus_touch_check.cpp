// Holds what the controller wrote down (tactusd --record) against what the emulated device really
// did (tactus emulate --truth): both carry CLOCK_MONOTONIC.
//   bus_touch_check touch RUN.csv TRUTH.csv JOINTS [LIMIT [homed_there]]
// It touched, knew where it was, pushed as it said. `homed_there`: its zero is wherever it stood
// when it was homed, which its hand does not hold at the truth's zero.
//   bus_touch_check fault RUN.csv TRUTH.csv JOINTS LIMIT_MS
// It was stopped: torque is zero for good within LIMIT_MS of the last tick without fault.
//   bus_touch_check killed TRUTH.csv JOINTS AT_NS LIMIT_MS
// The controller got a signal at AT_NS: there was torque until then, and none LIMIT_MS later.
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

// The largest error from encoder, transport and the millisecond between two truths, rad or m.
constexpr double kJointLimit = 2e-4;

bool failed = false;

void expect(bool holds, const std::string& what) {
  fmt::print("{}: {}\n", holds ? "measured" : "FAILED", what);
  failed = failed || !holds;
}

CsvTable read(const std::string& file, const std::vector<std::string>& names) {
  const std::vector<std::string_view> views(names.begin(), names.end());
  return CsvTable::read(file, views);
}

// The true motion and torques of the device.
class Truth {
 public:
  Truth(const std::string& file, std::size_t joints) : table_(read(file, columns(joints))) {
    for (std::size_t joint = 0; joint < joints; ++joint) {
      position_.push_back(table_.column(fmt::format("joint_{}", joint)));
      torque_Nm_.push_back(table_.column(fmt::format("shaft_{}_torque_Nm", joint)));
    }
  }

  [[nodiscard]] std::size_t rows() const { return table_.rows(); }
  [[nodiscard]] std::span<const double> times_ns() const { return table_.column("t_ns"); }
  [[nodiscard]] double torque_Nm(std::size_t joint, std::size_t row) const {
    return torque_Nm_[joint][row];
  }

  // 0: there never was any.
  [[nodiscard]] double last_torque_ns() const {
    for (std::size_t row = rows(); row-- > 0;) {
      if (std::ranges::any_of(torque_Nm_, [&](const auto& of) { return of[row] != 0.0; })) {
        return times_ns()[row];
      }
    }
    return 0.0;
  }

  // Returns the position at a time, by linear interpolation between two rows; NaN outside.
  [[nodiscard]] double position_at(std::size_t joint, double t_ns) const {
    const auto times = times_ns();
    const auto after = std::ranges::lower_bound(times, t_ns);
    if (after == times.begin() || after == times.end()) {
      return std::numeric_limits<double>::quiet_NaN();
    }
    const auto i = static_cast<std::size_t>(after - times.begin());
    const double share = (t_ns - times[i - 1]) / (times[i] - times[i - 1]);
    return position_[joint][i - 1] + share * (position_[joint][i] - position_[joint][i - 1]);
  }

 private:
  [[nodiscard]] static std::vector<std::string> columns(std::size_t joints) {
    std::vector<std::string> names{"t_ns"};
    for (std::size_t i = 0; i < joints; ++i) {
      names.push_back(fmt::format("joint_{}", i));
      names.push_back(fmt::format("shaft_{}_torque_Nm", i));
    }
    return names;
  }

  CsvTable table_;
  std::vector<std::span<const double>> position_;  // by joint
  std::vector<std::span<const double>> torque_Nm_;
};

void check_last_torque(const Truth& truth, double since_ns, double limit_ms,
                       std::string_view what) {
  const double last_ns = truth.last_torque_ns();
  expect(last_ns > 0.0, "there was torque before");
  const double late_ms = (last_ns - since_ns) * 1e-6;
  expect(late_ms <= limit_ms, fmt::format("the last torque came {:.2f} ms after {}, {} ms allowed",
                                          late_ms, what, limit_ms));
}

// A millisecond lies between two truths, and between two commands.
constexpr double kStillTorque_ns = 3e6;

void check_killed(const Truth& truth, double at_ns, double limit_ms) {
  expect(truth.last_torque_ns() >= at_ns - kStillTorque_ns, "there was torque until the signal");
  check_last_torque(truth, at_ns, limit_ms, "the signal");
}

class Comparison {
 public:
  Comparison(const std::string& run, const std::string& truth, std::size_t joints)
      : joints_(joints), run_(read(run, run_columns(joints))), truth_(truth, joints) {
    for (std::size_t joint = 0; joint < joints; ++joint) {
      seen_.push_back(run_.column(fmt::format("joint{}", joint + 1)));
      commanded_Nm_.push_back(run_.column(fmt::format("torque{}_Nm", joint + 1)));
    }
  }

  void check_touch(double joint_limit, bool homed_there) const {
    const auto faults = run_.column("faults");
    expect(std::ranges::all_of(faults, [](double bits) { return bits == 0.0; }), "no fault");
    check_joints(joint_limit, homed_there);
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
    check_last_torque(truth_, done[row - 1], limit_ms, "the last good tick");
  }

 private:
  [[nodiscard]] static std::vector<std::string> run_columns(std::size_t joints) {
    std::vector<std::string> names{"done_ns",       "sample_ns", "faults",    "contact",
                                   "device_status", "force_x_N", "force_y_N", "force_z_N"};
    for (std::size_t i = 1; i <= joints; ++i) {
      names.push_back(fmt::format("joint{}", i));
      names.push_back(fmt::format("torque{}_Nm", i));
    }
    return names;
  }
  void check_joints(double limit, bool homed_there) const {
    const auto times = run_.column("sample_ns");
    double worst = 0.0;
    for (std::size_t joint = 0; joint < joints_; ++joint) {
      const double zero = homed_there ? truth_.position_at(joint, times[homed_row()]) : 0.0;
      for (std::size_t row = run_.rows() / 10; row < run_.rows(); ++row) {
        const double truth = truth_.position_at(joint, times[row]);
        if (std::isfinite(truth)) {
          worst = std::max(worst, std::abs(seen_[joint][row] - (truth - zero)));
        }
      }
    }
    expect(worst <= limit,
           fmt::format("joints are at most {:.2e} (rad or m) from where they really are", worst));
  }

  // The first that the device does not call unreferenced.
  [[nodiscard]] std::size_t homed_row() const {
    const auto status = run_.column("device_status");
    const auto homed = std::ranges::find(status, 0.0);
    return homed == status.end() ? 0 : static_cast<std::size_t>(homed - status.begin());
  }

  // Compares the motors' torque at each time of the truth with the torque commanded by then.
  void check_torques() const {
    const auto done = run_.column("done_ns");
    const auto times = truth_.times_ns();
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
      const double real = truth_.torque_Nm(joint, truth_row);
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
  Truth truth_;
  // By joint.
  std::vector<std::span<const double>> seen_;
  std::vector<std::span<const double>> commanded_Nm_;
};

int check(std::span<char*> arguments) {
  const std::string_view what = arguments.size() < 5 ? "" : arguments[1];
  const auto number = [&](std::size_t i, double otherwise) {
    return i < arguments.size() ? std::atof(arguments[i]) : otherwise;
  };
  if (what == "touch" || what == "fault") {
    const Comparison comparison(arguments[2], arguments[3],
                                static_cast<std::size_t>(number(4, 0.0)));
    if (what == "touch") {
      const bool homed_there =
          arguments.size() > 6 && std::string_view(arguments[6]) == "homed_there";
      comparison.check_touch(number(5, kJointLimit), homed_there);
    } else {
      comparison.check_fault(number(5, 5.0));
    }
  } else if (what == "killed") {
    check_killed(Truth(arguments[2], static_cast<std::size_t>(number(3, 0.0))), number(4, 0.0),
                 number(5, 5.0));
  } else {
    fmt::print(stderr,
               "usage: bus_touch_check touch|fault RUN.csv TRUTH.csv JOINTS [LIMIT [homed_there]]\n"
               "       bus_touch_check killed TRUTH.csv JOINTS AT_NS [LIMIT_MS]\n");
    return 2;
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
