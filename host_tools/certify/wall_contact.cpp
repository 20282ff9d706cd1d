#include "host_tools/certify/wall_contact.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "firmware/control/run_tick.h"
#include "firmware/safety/faults.h"
#include "host_tools/configure_controller.h"
#include "host_tools/input_error.h"
#include "rendering/geometry/portable_math.h"

namespace tactus::host {
namespace {

// The numbers of the trial and of the verdict, as the header describes them. The press is reduced
// so that the wall is never deeper than kDeepest_m.
constexpr double kShareOfLiftOff = 0.7;
constexpr double kDeepest_m = 0.005;
constexpr int kWindows = 5;
constexpr double kPeriodsInWindow = 4.0;
constexpr double kShortestWindow_s = 0.15;
constexpr double kShortestQuiet_s = 0.1;
constexpr double kLeastLoss = 1e-3;
// The guide: a damper without a spring, stiff enough to move the handle through any wall at its
// speed.
constexpr HandParameters kGuide{.damping_Ns_per_m = 2000.0};
// How long the guide moves before it reaches the wall, and how soon the controller must be active.
constexpr double kApproach_s = 0.01;
constexpr int kMostTicksToActive = 20;

// The course of a trial, from the numbers of the ideal contact.
struct Course {
  double press_N = 0.0;
  // The depth at which the wall carries the press.
  double depth_m = 0.0;
  double speed_m_per_s = 0.0;
  double period_s = 0.0;
};

// The ideal contact is a mass on the two springs of wall and hand, with the period 2 pi sqrt(m /
// k). At the depth of the press, a speed of depth * 2 pi / period would let the handle swing back
// to the surface; it moves at kShareOfLiftOff of that.
Course plan_course(const WallContact& contact, const WallStiffness& wall) {
  const double mass = contact.device.plant.moving_mass_kg + contact.hand.mass_kg;
  const double stiffness = wall.stiffness_N_per_m + contact.hand.stiffness_N_per_m;
  Course course;
  course.press_N = std::min(contact.press_N, wall.stiffness_N_per_m * kDeepest_m);
  course.depth_m = course.press_N / wall.stiffness_N_per_m;
  course.period_s = 2.0 * std::numbers::pi * std::sqrt(mass / stiffness);
  course.speed_m_per_s =
      kShareOfLiftOff * course.depth_m * 2.0 * std::numbers::pi / course.period_s;
  return course;
}

// The hand that presses, and where it wants to be for that.
struct Press {
  HandParameters hand;
  Vec3 wish_B = Vec3::Zero();
};

// Returns the hand whose spring pushes with the press where the wall carries it.
Press press_of(const WallContact& contact, const Course& course) {
  // A hand that is off presses by a spring so soft and long that its force does not change.
  constexpr double kSoft_N_per_m = 1e-3;
  Press press{.hand = contact.hand};
  if (press.hand.stiffness_N_per_m == 0.0) {
    press.hand.stiffness_N_per_m = kSoft_N_per_m;
  }
  const double beyond_m = course.depth_m + course.press_N / press.hand.stiffness_N_per_m;
  press.wish_B = contact.point_B - beyond_m * contact.normal_B;
  return press;
}

// Returns a plane through the world's origin, with the contact's normal as its outside.
rendering::Object wall_object(const WallContact& contact, const WallStiffness& wall) {
  rendering::Object object;
  object.surface = rendering::SurfaceKind::primitive;
  object.primitive.kind = rendering::PrimitiveKind::plane;
  // The plane's outside is its own y-axis; the turn about the normal changes nothing.
  const Vec3 along_B = contact.normal_B.unitOrthogonal();
  object.primitive.X_WO.rotation << along_B, contact.normal_B, along_B.cross(contact.normal_B);
  object.material.stiffness_N_per_m = wall.stiffness_N_per_m;
  object.material.damping_Ns_per_m = wall.damping_Ns_per_m;
  return object;
}

// The device's start is no part of the trial.
DeviceParameters ready_at_once(DeviceParameters device) {
  device.power_up_s = 0.0;
  device.homing_s = 0.0;
  return device;
}

// Prepares the controller with its full force from the first tick and without passivity control:
// the certificate is for the bare wall, and that control is for walls without a certificate.
void prepare(firmware::Controller& controller, const WallContact& contact,
             std::span<const rendering::Object> wall) {
  firmware::ControllerConfig config = contact.controller;
  config.workspace_origin_D = contact.point_B;
  config.safety.soft_start_s = 0.0;
  // The sign check would push by itself; here the wall alone pushes.
  config.safety.sign_check_N = 0.0;
  config.safety.contact_start_s = 0.0;
  // Nothing may damp the wall, and the trial itself gives the verdict on it.
  config.safety.passivity_damping_Ns_per_m = 0.0;
  config.safety.guards_off = firmware::kFaultNotPassive;
  config.allow_uncertified = true;
  configure(controller, config);
  if (!controller.load_scene(wall, {.tool_radius_m = 0.0})) {
    throw InputError("the controller refused the wall");
  }
}

// The handle on the wall, tick by tick.
class Contact {
 public:
  Contact(firmware::Controller& controller, const WallContact& contact, const Course& course)
      : controller_(controller),
        contact_(contact),
        course_(course),
        tick_s_(1.0 / contact.controller.rate_hz),
        guide_B_(contact.point_B + kApproach_s * course.speed_m_per_s * contact.normal_B),
        device_(ready_at_once(contact.device), tick_s_, guide_B_) {}

  // Moves the handle in. Returns true if the motors are on and the handle is where the wall carries
  // the press.
  bool lead_in() {
    for (int i = 0; i < kMostTicksToActive && controller_.mode() != firmware::Mode::active; ++i) {
      tick(kGuide, guide_B_, guide_B_);
    }
    const Vec3 step_B = -tick_s_ * course_.speed_m_per_s * contact_.normal_B;
    const auto most_ticks = static_cast<int>(
        2.0 * (kApproach_s + course_.depth_m / course_.speed_m_per_s) / tick_s_ + 10.0);
    for (int i = 0; i < most_ticks && depth_m() < course_.depth_m; ++i) {
      tick(kGuide, guide_B_, guide_B_ + step_B);
      guide_B_ += step_B;
    }
    return active();
  }

  // Makes one tick of the hand's press; returns the square of the handle's speed after it, m^2/s^2.
  double press(const Press& press) {
    tick(press.hand, press.wish_B, press.wish_B);
    return device_.plant().v_B().squaredNorm();
  }

  [[nodiscard]] bool active() const { return controller_.mode() == firmware::Mode::active; }
  [[nodiscard]] double tick_s() const { return tick_s_; }

 private:
  void tick(const HandParameters& hand, const Vec3& wish_B, const Vec3& next_wish_B) {
    firmware::run_tick(controller_, device_, firmware::request_toward_active(controller_.mode()));
    device_.advance(hand, wish_B, next_wish_B);
  }
  [[nodiscard]] double depth_m() const {
    return contact_.normal_B.dot(contact_.point_B - device_.plant().p_B());
  }

  firmware::Controller& controller_;
  const WallContact& contact_;
  const Course& course_;
  double tick_s_;
  Vec3 guide_B_;
  SimulatedDevice device_;
};

// The lengths of a window and of the stretch that must be quiet, ticks.
struct WindowTicks {
  int all = 0;
  // Ticks of one period: a slow oscillation has no speed where it turns.
  int for_quiet = 0;
};

// Returns the mean of the squared speed in the window, weighted with a Hann window; 0 if it became
// quiet.
double motion_in_window(Contact& contact, const Press& press, const WindowTicks& ticks) {
  constexpr double kQuiet = kQuietSpeed_m_per_s * kQuietSpeed_m_per_s;
  const double turn = 2.0 * std::numbers::pi / ticks.all;
  double weighted = 0.0;
  double since = 0.0;
  for (int i = 0; i < ticks.all; ++i) {
    const double squared_speed = contact.press(press);
    weighted += (1.0 - rendering::sine_cosine(turn * (i + 0.5)).cosine) * squared_speed;
    since += squared_speed;
    if ((i + 1) % ticks.for_quiet == 0) {
      if (since < kQuiet * ticks.for_quiet && contact.active()) {
        return 0.0;
      }
      since = 0.0;
    }
  }
  return weighted / ticks.all;
}

}  // namespace

ContactVerdict ContactTrial::run(const WallContact& contact, const WallStiffness& wall) {
  auto& [objects, controller] = *setup_;
  objects = {wall_object(contact, wall)};
  prepare(controller, contact, objects);
  const Course course = plan_course(contact, wall);
  const Press press = press_of(contact, course);
  Contact now(controller, contact, course);
  if (!now.lead_in()) {
    return ContactVerdict::fault;
  }
  const auto ticks_of = [&](double seconds) {
    return static_cast<int>(std::ceil(seconds / now.tick_s()));
  };
  const WindowTicks ticks{
      .all = ticks_of(std::max(kPeriodsInWindow * course.period_s, kShortestWindow_s)),
      .for_quiet = ticks_of(std::max(course.period_s, kShortestQuiet_s))};
  // The first period is not judged: the change from the guide to the hand disturbs it.
  (void)motion_in_window(now, press, {ticks_of(course.period_s), ticks.for_quiet});
  double before = std::numeric_limits<double>::infinity();
  for (int window = 0; window < kWindows; ++window) {
    const double motion = motion_in_window(now, press, ticks);
    if (!now.active()) {
      return ContactVerdict::fault;
    }
    if (motion == 0.0) {
      return ContactVerdict::quiet;
    }
    if (motion > (1.0 - kLeastLoss) * before) {
      return ContactVerdict::sustained;
    }
    before = motion;
  }
  return ContactVerdict::settling;
}

}  // namespace tactus::host
