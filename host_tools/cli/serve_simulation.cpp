#include "host_tools/cli/serve_simulation.h"

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "firmware/commands/injection.h"
#include "firmware/linux/commands/device_folders.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/realtime/loop_timing.h"
#include "hal/linux/clock.h"
#include "host_tools/cli/served_device.h"
#include "host_tools/input_error.h"
#include "rendering/limits.h"

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

// A simulation of one or several devices with the services of each, and one scene.
class ServedSimulation {
 public:
  ServedSimulation(const std::filesystem::path& scene, const RunOptions& run, ServeOptions options)
      : options_(std::move(options)), rate_hz_(run.rate_hz) {
    const rendering::SceneImage& image = open(scene);
    RunPlan plan = plan_run(run, image);
    for (SimulationConfig& config : plan.devices) {
      config.path = config.path.there_and_back();
    }
    for (const std::string& warning : plan.warnings) {
      fmt::print(stderr, "tactus sim: warning: {}\n", warning);
    }
    simulation_ =
        std::make_unique<Simulation>(plan.devices, image.objects(), image.tool_radius_m());
    simulation_->controller().set_clock(clock_now_ns);
    if (run.seconds) {
      ticks_ = static_cast<std::uint64_t>(*run.seconds * rate_hz_);
    }
    serve(run.devices);
  }

  // Ticks in wall-clock time until the time is over or a signal comes.
  void run() {
    hal::LinuxClock clock;
    const hal::Phase phase{.period_ns = static_cast<hal::TimeNs>(1e9 / rate_hz_)};
    hal::Wake wake = clock.sleep_until(hal::next_instant_ns(phase, clock.now_ns()));
    timing_.set_period(phase.period_ns);
    for (; ticks_ > 0 && !g_is_to_end.load(std::memory_order_relaxed); --ticks_) {
      timing_.woke(wake);
      ++served_;
      tick(wake);
      wake = clock.sleep_to_phase(phase, wake);
    }
    for (const auto& device : devices_) {
      device->stop();
    }
  }

  // Returns how many ticks were served, and how many came late.
  [[nodiscard]] std::string summary() const {
    return fmt::format("served {} ticks; {} began more than half a period late, {} were left out",
                       served_, timing_.late(), timing_.missed());
  }

  [[nodiscard]] std::size_t device_count() const { return devices_.size(); }

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

  // Starts the services of all devices.
  void serve(const std::vector<std::string>& devices) {
    for (std::size_t i = 0; i < simulation_->device_count(); ++i) {
      devices_.push_back(std::make_unique<ServedDevice>(i, options_.run_dir));
      devices_[i]->start_telemetry(*simulation_, *scenes_, rate_hz_, options_);
      if (i > 0) {
        companions_.push_back(&devices_[i]->telemetry().writer());
      }
    }
    name_devices(devices);
    devices_.front()->telemetry().sinks().companions = companions_;
    for (std::size_t i = 0; i < devices_.size(); ++i) {
      devices_[i]->start_commands(i == 0 ? scenes_.get() : nullptr, options_.allow_inject);
    }
  }

  // Links the names of the presets, or of the devices' files, where they tell the devices apart.
  void name_devices(const std::vector<std::string>& devices) const {
    std::vector<std::string> stems;
    stems.reserve(devices.size());
    for (const std::string& device : devices) {
      stems.push_back(std::filesystem::path(device).stem().string());
    }
    std::vector<std::string_view> names(stems.begin(), stems.end());
    if (names.size() < simulation_->device_count()) {
      names.clear();  // one preset stands for all devices
    }
    const std::string folder = options_.run_dir.string();
    if (const int error = firmware::link_device_names(folder.c_str(), names); error != 0) {
      throw InputError(fmt::format("{}: {}", folder, std::strerror(error)));
    }
  }

  // Makes one tick as tactusd does: the requests of the sockets, the tick, its records.
  void tick(const hal::Wake& wake) {
    firmware::Controller& controller = simulation_->controller();
    std::array<firmware::Request, rendering::kMaxTools> requests{};
    for (std::size_t i = 0; i < devices_.size(); ++i) {
      requests[i] = devices_[i]->queue().before_tick(controller);
    }
    simulation_->tick(std::span(requests).first(devices_.size()),
                      [this](SimulatedDevice& device, std::size_t number) {
                        return firmware::InjectedDevice(
                            device, devices_[number]->queue().injector(), rate_hz_, clock_now_ns);
                      });
    for (const auto& device : devices_) {
      device->publish(controller, wake);
    }
  }

  ServeOptions options_;
  double rate_hz_;
  // The ticks that are left.
  std::uint64_t ticks_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t served_ = 0;
  // Being late is no fault of a simulation: the controller is not told.
  firmware::LoopTiming timing_;
  // It has a megabyte, too much for the stack. Members are destroyed in reverse order: the servers
  // go before what they serve.
  std::unique_ptr<firmware::SceneStore> scenes_ = std::make_unique<firmware::SceneStore>();
  std::unique_ptr<Simulation> simulation_;
  std::vector<firmware::TelemetryWriter*> companions_;
  std::vector<std::unique_ptr<ServedDevice>> devices_;
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
             "tactus sim: serving in {}; try: tactus home --wait && tactus enable{}; Ctrl-C ends\n",
             options.run_dir.string(),
             served.device_count() > 1 ? ", and both with --device 2 or the preset's name" : "");
  served.run();
  fmt::print(stderr, "tactus sim: {}\n", served.summary());
}

}  // namespace tactus::host
