// The controller: one object in static storage that turns a joint sample into a joint command, once
// a tick.
//
// Thread: none of its own and no locks; one thread configures it, loads a scene and then ticks it.
// No member allocates, throws, blocks or prints. World frame W: right-handed, x right, y up, z
// toward the user; the device frame D moved to workspace_origin_D.
#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>

#include "drivers/device.h"
#include "firmware/configuration/controller_config.h"
#include "firmware/control/friction_compensation.h"
#include "firmware/control/gravity_compensation.h"
#include "firmware/control/material_changes.h"
#include "firmware/control/mode.h"
#include "firmware/control/parameters.h"
#include "firmware/control/velocity_filter.h"
#include "firmware/kinematics/mechanism.h"
#include "firmware/safety/effort_guard.h"
#include "firmware/safety/encoder_guard.h"
#include "firmware/safety/energy_account.h"
#include "firmware/safety/force_limiter.h"
#include "firmware/safety/loop_check.h"
#include "firmware/safety/motion_guard.h"
#include "firmware/safety/motor_sign_check.h"
#include "firmware/safety/passivity.h"
#include "firmware/safety/sample_check.h"
#include "firmware/safety/workspace_walls.h"
#include "firmware/telemetry/record.h"
#include "firmware/telemetry/stopwatch.h"
#include "rendering/state/state_archive.h"
#include "rendering/world/world.h"

namespace tactus::firmware {

// Why a scene was not loaded.
enum class SceneFault : std::uint8_t {
  active,       // not while the motors are on
  world,        // the world refused it: World::set_scene
  uncertified,  // a part of it is beyond the configuration's certificate
};
struct SceneRefusal {
  SceneFault fault = SceneFault::active;
  UncertifiedPart part;  // which, if uncertified
};

class Controller {
 public:
  // Takes a valid configuration and starts afresh in `init`; keeps the scene. An invalid one
  // changes nothing, and neither does one whose certificate the loaded scene is beyond: the field
  // is then "certificate" and the value a stiffness. A wall of the workspace beyond the certificate
  // is refused too, by the name of its stiffness or its damping.
  std::expected<void, ConfigError> configure(const ControllerConfig& config);

  // Gives the world a scene; the memory behind the objects must outlive it. Refused while active
  // and when a part of it, or parts that push together or with a wall of the workspace, are stiffer
  // than the configuration's certificate allows, unless `allow_uncertified`: both keep the world as
  // it is. When the world refuses it, it is empty.
  std::expected<void, SceneRefusal> load_scene(std::span<const rendering::Object> objects,
                                               const rendering::WorldConfig& config);

  // Between ticks: from the next one on the parameter has that value, and its record says so. At
  // most one a tick gets into the record. Nothing changed if refused. Bounded, for a tick's edge.
  std::expected<ParameterEvent, ParameterRefusal> set_parameter(const ParameterChange& change);
  [[nodiscard]] std::expected<ParameterValue, ParameterRefusal> parameter(
      const ParameterPlace& place) const;
  // Names what the last set_parameter that was `uncertified` would have put beyond the certificate.
  [[nodiscard]] const UncertifiedPart& uncertified_part() const { return uncertified_part_; }

  // One tick: the same state and inputs give the same command and the same record, to the bit.
  // Whatever comes in, the command is finite and within its limits.
  drivers::JointCommand tick(const drivers::JointSample& fresh, Request request);

  // Between ticks: writes all that the next ticks depend on, for restore() in any process and on
  // any processor. The number of bytes, at most kMaxCheckpointBytes for one tool; 0 if the room is
  // too small, nothing is configured, or a number is not finite, as it can be after a fault. For a
  // tick's slack: it copies, at the most half a megabyte.
  std::size_t save(std::span<std::byte> room);

  // Goes on where save() was called: the ticks after it give the same bits. To be called on a
  // controller of the same configuration and scene, both set before. False if the bytes are not of
  // such a one: then configure and load the scene again.
  bool restore(std::span<const std::byte> bytes);

  // What the last tick did.
  [[nodiscard]] const TelemetryRecord& record() const { return record_; }
  [[nodiscard]] Mode mode() const { return mode_; }
  [[nodiscard]] const ControllerConfig& config() const { return config_; }
  // What the next tick's record will count itself.
  [[nodiscard]] std::uint64_t next_tick() const { return next_tick_; }

  // The clock for the record's stage times; null, as at the start, leaves them zero.
  void set_clock(NowNs now_ns) { now_ns_ = now_ns; }
  [[nodiscard]] NowNs clock() const { return now_ns_; }

  // Before a tick, from the loop: how its time went. The next tick takes it, and only that one.
  void note_loop(const LoopReport& report) { loop_report_ = report; }

  // After each tick, from the device loop: what the write reported, which the next tick takes as
  // part of its sample's status, and the transfers' times.
  void note_transfers(std::uint32_t write_status, std::uint32_t read_ns, std::uint32_t write_ns);

 private:
  void open_record(const drivers::JointSample& sample, Request request);
  void record_touch(const rendering::Touch& touch);
  void close_record(const drivers::JointCommand& command);
  void raise(std::uint64_t bits);
  void step_mode(Event event);
  void advance_mode(std::uint32_t status, Request request);
  void check_encoders(const drivers::JointSample& sample);
  void check_efforts(const drivers::JointSample& sample);
  void blame(const EffortFinding& found);
  bool locate(const drivers::JointSample& sample);
  rendering::Touch touch(bool located);
  void bring_changes_in();
  Vec3 limit_force(const rendering::Touch& touch);
  Vec3 add_safety(bool pushes);
  Vec3 hold_up(const drivers::JointSample& sample);
  drivers::JointCommand command_joints(const drivers::JointSample& sample, const Vec3& force_W);
  void transfer(rendering::StateArchive& archive);
  void transfer_guards(rendering::StateArchive& archive);
  void transfer_parameters(rendering::StateArchive& archive);
  void transfer_pose(rendering::StateArchive& archive);
  void transfer_record(rendering::StateArchive& archive);
  Vec3 compensated(const drivers::JointSample& sample, const Vec3& effort, double force_N);

  void apply_own(const ParameterChange& change);
  // The loaded scene as it comes to feel, with one object's material in place of its own, if any.
  struct WantedMaterials {
    const Controller* controller = nullptr;
    const rendering::Material* changed = nullptr;
    std::uint32_t object = 0;
  };
  [[nodiscard]] static FeltScene felt_scene(const WantedMaterials& materials,
                                            const SafetyConfig& safety);
  bool is_certified(std::uint32_t object, const rendering::Material& material);
  void retune();

  ControllerConfig config_;         // with what set_parameter has changed
  SafetyConfig configured_safety_;  // as configure() got it: the ends of the parameters' ranges
  ParameterChange change_;          // for the next tick's record
  bool configured_ = false;
  Mechanism mechanism_;
  SampleCheck sample_check_;
  LoopCheck loop_check_;
  EncoderGuard encoder_guard_;
  EffortGuard effort_guard_;
  MotorSignCheck sign_check_;
  WorkspaceWalls workspace_walls_;
  MotionGuard motion_guard_;
  EnergyAccount energy_;
  PassivityControl passivity_;
  VelocityFilter velocity_filter_;
  ForceLimiter force_limiter_;
  GravityCompensation gravity_compensation_;
  FrictionCompensation friction_compensation_;
  rendering::World world_;
  MaterialChanges material_changes_;
  std::span<const rendering::Object> objects_;  // of the world's scene
  std::span<const rendering::Effect> effects_;
  double tool_radius_m_ = 0.0;
  UncertifiedPart uncertified_part_;  // for people alone

  Mode mode_ = Mode::init;
  std::uint64_t faults_ = 0;        // latched
  std::uint32_t fault_joint_ = 0;   // that a latched fault of effort_guard_ is about
  std::uint64_t raised_ = 0;        // faults and limits of this tick
  std::uint32_t write_status_ = 0;  // of the last write
  LoopReport loop_report_;          // for the next tick
  JointEfforts held_effort_{};      // commanded by the last tick
  Pose pose_;
  rendering::ToolState tool_;
  TelemetryRecord record_;
  std::uint64_t next_tick_ = 0;
  NowNs now_ns_ = nullptr;
};

}  // namespace tactus::firmware
