#include "host_tools/cli/serve_simulation.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/commands/command_queue.h"
#include "firmware/linux/commands/command_server.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/commands/telemetry_hooks.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/explanation_source.h"
#include "firmware/linux/telemetry/telemetry_writer.h"
#include "hal/linux/clock.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "rendering/scene/scene_world.h"

namespace tactus::host {
namespace {

// A signal handler can reach nothing but globals.
std::atomic<bool> g_is_to_end{false};

void on_end_signal(int /*signal*/) {
  g_is_to_end.store(true, std::memory_order_relaxed);
}

std::uint64_t clock_now_ns() {
  return static_cast<std::uint64_t>(hal::monotonic_now_ns());
}

// Throws InputError with the system's reason.
[[noreturn]] void refuse_folder(const std::string& path, std::string_view what, int error) {
  throw InputError(
      fmt::format("{}: {} ({}); --run-dir names another folder", path, what, std::strerror(error)));
}

// The recording and the live telemetry of a run.
class ServedTelemetry {
 public:
  // Starts both with what a replay needs: scene and configuration. The scene must outlive the
  // telemetry. Throws InputError.
  void start(const Simulation& simulation, const firmware::SceneStore& scenes, double rate_hz,
             const ServeOptions& options) {
    const std::string socket = (options.run_dir / "telemetry.sock").string();
    if (const int error = writer_->open_live_socket(socket.c_str()); error != 0) {
      refuse_folder(socket, "cannot be opened", error);
    }
    describe(simulation, scenes, rate_hz);
    const std::string& file = options.record;
    if (const int error = file.empty() ? 0 : writer_->record(file.c_str()); error != 0) {
      throw InputError(fmt::format("{}: {}", file, std::strerror(error)));
    }
    if (const int error = writer_->start(); error != 0) {
      refuse_folder(socket, "no thread", error);
    }
  }

  // Publishes the controller's record of the tick that began with `wake`.
  void publish(firmware::Controller& controller, const hal::Wake& wake) {
    firmware::RecordedTick recorded{.record = controller.record(),
                                    .loop = {.scheduled_ns = wake.scheduled_ns,
                                             .woke_ns = wake.woke_ns,
                                             .done_ns = hal::monotonic_now_ns(),
                                             .sample_ns = wake.woke_ns},
                                    .joint_count = static_cast<std::uint32_t>(joints_)};
    recorded.shaft_rad = recorded.record.joint_position;
    recorded.torque_Nm = recorded.record.joint_effort;
    writer_->publish(recorded);
    explanations_.after_tick(controller, wake.scheduled_ns, *writer_);
  }

  // Ends the recording. Throws InputError if it ended early.
  void stop() {
    if (const int error = writer_->stop(); error != 0) {
      throw InputError(fmt::format("the recording ended early: {}", std::strerror(error)));
    }
  }

  // Returns where the controller's events go.
  [[nodiscard]] firmware::TelemetrySinks& sinks() { return sinks_; }

 private:
  // The run in words, and the entries that view them.
  struct RunWords {
    std::string rate;
    std::string joints;
    std::string checksum;
    std::array<firmware::MetadataEntry, 4> entries;
  };

  // Gives the writer the run's properties, its scene and its configuration.
  void describe(const Simulation& simulation, const firmware::SceneStore& scenes, double rate_hz) {
    timespec now{};
    ::clock_gettime(CLOCK_REALTIME, &now);
    joints_ = firmware::joint_count(simulation.config().mechanism);
    words_.rate = fmt::format("{}", rate_hz);
    words_.joints = fmt::format("{}", joints_);
    words_.checksum = fmt::format("{:016x}", scenes.scene()->checksum());
    words_.entries = {{{"program", "tactus sim"},
                       {"rate_hz", words_.rate},
                       {"joints", words_.joints},
                       {firmware::kSceneChecksumKey, words_.checksum}}};
    writer_->describe({.info = words_.entries,
                       .joints = joints_,
                       .clock_offset_ns = hal::to_ns(now) - hal::monotonic_now_ns()});
    writer_->attach({.name = firmware::kSceneAttachment, .bytes = scenes.bytes()});
    const std::size_t size = firmware::save_config(simulation.config(), config_);
    writer_->attach({.name = firmware::kConfigAttachment, .bytes = std::span(config_).first(size)});
  }

  std::size_t joints_ = 0;
  RunWords words_;
  std::array<std::byte, firmware::kMaxConfigBytes> config_{};
  // It has megabytes, too many for the stack.
  std::unique_ptr<firmware::TelemetryWriter> writer_ =
      std::make_unique<firmware::TelemetryWriter>();
  firmware::ExplanationSource explanations_;
  firmware::TelemetrySinks sinks_{.writer = writer_.get()};
};

// The services of tactusd (telemetry, commands, scenes) around a simulated device.
class ServedSimulation {
 public:
  ServedSimulation(const std::filesystem::path& scene, const RunOptions& run, ServeOptions options)
      : options_(std::move(options)), rate_hz_(run.rate_hz) {
    const rendering::SceneImage& image = open(scene);
    RunPlan plan = plan_run(run, image.objects(), image.tool_radius_m());
    if (plan.devices.size() > 1) {
      throw InputError("--serve: one device only; without it sim takes several");
    }
    SimulationConfig& config = plan.devices.front();
    config.path = config.path.there_and_back();
    config.world = rendering::world_of(image);
    for (const std::string& warning : plan.warnings) {
      fmt::print(stderr, "tactus sim: warning: {}\n", warning);
    }
    simulation_ = std::make_unique<Simulation>(config, image.objects(), image.tool_radius_m());
    simulation_->controller().set_clock(clock_now_ns);
    if (run.seconds) {
      ticks_ = static_cast<std::uint64_t>(*run.seconds * rate_hz_);
    }
    std::filesystem::create_directories(options_.run_dir);
    telemetry_.start(*simulation_, *scenes_, rate_hz_, options_);
    start_commands();
  }

  // Ticks in wall-clock time until the time is over or a signal comes.
  void run() {
    hal::LinuxClock clock;
    const hal::Phase phase{.period_ns = static_cast<hal::TimeNs>(1e9 / rate_hz_)};
    hal::Wake wake = clock.sleep_until(hal::next_instant_ns(phase, clock.now_ns()));
    for (; ticks_ > 0 && !g_is_to_end.load(std::memory_order_relaxed); --ticks_) {
      tick(wake);
      wake = clock.sleep_to_phase(phase, wake);
    }
    server_->stop();
    telemetry_.stop();
  }

 private:
  // Maps the scene as tactusd does, so that a command can exchange it later.
  const rendering::SceneImage& open(const std::filesystem::path& path) {
    const auto opened = scenes_->open_next(std::filesystem::absolute(path).string());
    if (!opened) {
      const int error = opened.error().errno_value;
      throw InputError(fmt::format("{}: {}{}{}", path.string(), opened.error().what,
                                   error == 0 ? "" : ": ", error == 0 ? "" : std::strerror(error)));
    }
    scenes_->use_next();
    return **opened;
  }

  // Starts the threads that listen to requests and to the stop.
  void start_commands() {
    const std::string socket = (options_.run_dir / kCommandSocket).string();
    const std::string stop_socket = (options_.run_dir / kStopSocket).string();
    queue_->set_events(firmware::telemetry_events(telemetry_.sinks()));
    const auto started = server_->start({.socket_path = socket.c_str(),
                                         .stop_socket_path = stop_socket.c_str(),
                                         .allow_inject = options_.allow_inject,
                                         .hooks = firmware::telemetry_hooks(telemetry_.sinks())});
    if (!started) {
      refuse_folder(socket, started.error().what, started.error().errno_value);
    }
  }

  // Makes one tick as tactusd does: the request of the sockets, the tick, its record.
  void tick(const hal::Wake& wake) {
    firmware::Controller& controller = simulation_->controller();
    const firmware::Request request = queue_->before_tick(controller);
    simulation_->tick(request, [this](SimulatedDevice& device) {
      return firmware::InjectedDevice(device, queue_->injector(), rate_hz_, clock_now_ns);
    });
    queue_->after_tick(controller);
    telemetry_.publish(controller, wake);
  }

  ServeOptions options_;
  double rate_hz_;
  // The ticks that are left.
  std::uint64_t ticks_ = std::numeric_limits<std::uint64_t>::max();
  // Each has megabytes, too many for the stack. Members are destroyed in reverse order: the server
  // goes before what it serves.
  std::unique_ptr<firmware::SceneStore> scenes_ = std::make_unique<firmware::SceneStore>();
  std::unique_ptr<Simulation> simulation_;
  ServedTelemetry telemetry_;
  std::unique_ptr<firmware::CommandQueue> queue_ = std::make_unique<firmware::CommandQueue>();
  std::unique_ptr<firmware::CommandServer> server_ =
      std::make_unique<firmware::CommandServer>(*queue_, scenes_.get());
};

}  // namespace

void serve_simulation(const std::filesystem::path& scene, const RunOptions& run,
                      const ServeOptions& options) {
  struct sigaction action{};
  action.sa_handler = on_end_signal;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  ServedSimulation served(scene, run, options);
  fmt::print(stderr,
             "tactus sim: serving in {}; try: tactus home --wait && tactus enable; Ctrl-C ends\n",
             options.run_dir.string());
  served.run();
}

}  // namespace tactus::host
