#include "host_tools/foxglove/foxglove_session.h"

#include <fmt/format.h>
#include <poll.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "host_tools/foxglove/live_device.h"
#include "host_tools/foxglove/scene_messages.h"
#include "host_tools/foxglove/schemas.h"
#include "host_tools/foxglove/served_scene.h"
#include "host_tools/foxglove/tick_messages.h"
#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

using std::chrono::steady_clock;
using namespace std::chrono_literals;

// The channels of the scene, before those of the devices.
enum SceneChannel : std::size_t { kSceneChannel, kFramesChannel, kSceneChannels };

// The live sockets bring ticks in groups; clients are served so often between them.
constexpr auto kTurn = 5ms;
// A controller sends its ticks from the beginning on.
constexpr auto kFirstTick = 5s;
// While there is no scene to show, the controller is asked for one so often.
constexpr auto kBetweenQuestions = 1s;

// Written by a signal, read by the loop.
volatile std::sig_atomic_t foxglove_is_to_end = 0;

void end_on_foxglove_signals() {
  struct sigaction action{};
  action.sa_handler = [](int /*signal*/) { foxglove_is_to_end = 1; };
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    ::sigaction(signal, &action, nullptr);
  }
}

// A device with its topics and the place of their channels.
struct ShownDevice {
  LiveDevice live;
  std::optional<DeviceTopics> topics;
  std::size_t first_channel = 0;
};

// Returns the places of the devices that are shown. Where no device is there, the first one's: an
// attempt to reach it says why.
std::vector<DevicePlace> places_of(const FoxgloveOptions& options) {
  if (!options.only_folder.empty()) {
    return {{.name = {}, .folder = options.only_folder}};
  }
  std::vector<DevicePlace> places = devices_in(options.first_folder);
  if (places.empty()) {
    places.push_back({.name = {}, .folder = options.first_folder});
  }
  return places;
}

class FoxgloveSession {
 public:
  explicit FoxgloveSession(const FoxgloveOptions& options)
      : first_folder_(options.first_folder),
        period_(std::chrono::duration_cast<steady_clock::duration>(
            std::chrono::duration<double>(1.0 / options.rate_Hz))) {
    const std::vector<DevicePlace> places = places_of(options);
    devices_.reserve(places.size());
    for (const DevicePlace& place : places) {
      devices_.push_back({.live = LiveDevice(place)});
    }
    server_ = std::make_unique<FoxgloveServer>(options.server);
  }

  [[nodiscard]] std::uint16_t port() const { return server_->port(); }

  void run(const std::function<bool()>& is_over) {
    wait_for_ticks(is_over);
    while (!is_ended(is_over)) {
      wait();
      take_messages();
      if (steady_clock::now() >= next_) {
        next_ = std::max(next_ + period_, steady_clock::now());
        publish();
      }
      server_->service();
    }
  }

 private:
  static bool is_ended(const std::function<bool()>& is_over) {
    return foxglove_is_to_end != 0 || is_over();
  }

  // The joints decide about topics, and the first tick tells them.
  void wait_for_ticks(const std::function<bool()>& is_over) {
    const auto begin = steady_clock::now();
    while (!is_ended(is_over) && !std::ranges::all_of(devices_, [](const ShownDevice& device) {
      return device.live.newest().has_value();
    })) {
      if (steady_clock::now() - begin > kFirstTick) {
        throw InputError("the controller sends no ticks; does it run? tactus status tells");
      }
      wait();
      take_messages();
    }
  }

  void wait() const {
    std::vector<pollfd> files;
    files.reserve(devices_.size());
    std::ranges::transform(devices_, std::back_inserter(files), [](const ShownDevice& device) {
      return pollfd{.fd = device.live.descriptor(), .events = POLLIN, .revents = 0};
    });
    ::poll(files.data(), files.size(), static_cast<int>(kTurn.count()));
  }

  void take_messages() {
    bool is_other_scene = false;
    for (ShownDevice& device : devices_) {
      is_other_scene = device.live.take_messages() || is_other_scene;
    }
    const bool are_there = std::ranges::all_of(
        devices_, [](const ShownDevice& device) { return device.live.is_there(); });
    // A controller that starts may not answer commands yet when its ticks come.
    const bool tries_again = are_there && !trouble_.empty() && steady_clock::now() >= ask_again_;
    if (is_other_scene || tries_again) {
      find_scene();
    }
    server_->set_status(FoxgloveLevel::warning,
                        are_there ? trouble_ : "the controller has ended; waiting for another");
  }

  void find_scene() {
    ask_again_ = steady_clock::now() + kBetweenQuestions;
    const std::string before = std::exchange(trouble_, scene_.find(first_folder_));
    const bool is_known_trouble = !trouble_.empty() && trouble_ == before;
    if (!trouble_.empty() && !is_known_trouble) {
      fmt::print(stderr, "tactus foxglove: {}\n", trouble_);
    }
    is_new_scene_ = is_new_scene_ || !is_known_trouble;
  }

  // Makes the channels where the devices have others than before.
  void set_channels() {
    bool is_same = true;
    for (const ShownDevice& device : devices_) {
      is_same = is_same && device.topics && device.topics->joints() == joints_of(device);
    }
    if (is_same) {
      return;
    }
    std::vector<FoxgloveChannel> channels = {
        {"/scene", kSceneUpdateSchema, scene_update_schema()},
        {"/tf", kFrameTransformsSchema, frame_transforms_schema()}};
    for (ShownDevice& device : devices_) {
      const std::string& name = device.live.place().name;
      device.topics.emplace(name.empty() ? name : "/" + name, joints_of(device));
      device.first_channel = channels.size();
      channels.insert(channels.end(), device.topics->channels().begin(),
                      device.topics->channels().end());
    }
    server_->set_channels(std::move(channels));
    is_new_scene_ = true;
  }

  static std::size_t joints_of(const ShownDevice& device) {
    const std::optional<firmware::RecordedTick>& newest = device.live.newest();
    return newest ? newest->joint_count : 0;
  }

  // Returns the time of the newest tick.
  static std::uint64_t time_of(const ShownDevice& device) {
    const std::optional<firmware::RecordedTick>& newest = device.live.newest();
    return newest ? device.live.time_of(newest->loop.scheduled_ns) : 0;
  }

  void publish() {
    set_channels();
    const std::uint64_t time_ns = time_of(devices_.front());
    publish_scene(time_ns);
    for (ShownDevice& device : devices_) {
      publish(device);
    }
  }

  void publish_scene(std::uint64_t time_ns) {
    const rendering::SceneImage* const image = scene_.image();
    if (is_new_scene_) {
      is_new_scene_ = false;
      server_->publish(
          kSceneChannel, time_ns,
          image == nullptr ? empty_scene_message(time_ns) : scene_message(*image, time_ns));
    }
    if (server_->is_wanted(kFramesChannel)) {
      server_->publish(kFramesChannel, time_ns, frames_message(image, places(), time_ns));
    }
  }

  [[nodiscard]] TimedPlaces places() const {
    const LiveDevice& device = devices_.front().live;
    const std::optional<firmware::ObjectPlaces>& newest = device.places();
    return newest ? TimedPlaces{.time_ns = device.time_of(newest->time_ns),
                                .places = std::span(newest->places).first(newest->count)}
                  : TimedPlaces{};
  }

  void publish(ShownDevice& device) {
    const auto& newest = device.live.newest();
    if (!device.live.is_there() || !newest || !device.topics) {
      return;
    }
    const std::uint64_t time_ns = time_of(device);
    const double radius_m = scene_.image() == nullptr ? 0.0 : scene_.image()->tool_radius_m();
    device.topics->take(*newest, time_ns, radius_m);
    for (std::size_t i = 0; i < device.topics->channels().size(); ++i) {
      if (server_->is_wanted(device.first_channel + i)) {
        server_->publish(device.first_channel + i, time_ns, device.topics->message(i));
      }
    }
  }

  std::filesystem::path first_folder_;
  steady_clock::duration period_;
  std::vector<ShownDevice> devices_;
  ServedScene scene_;
  bool is_new_scene_ = true;
  // Why there is no scene; empty if there is one.
  std::string trouble_;
  steady_clock::time_point ask_again_;
  std::unique_ptr<FoxgloveServer> server_;
  steady_clock::time_point next_;
};

}  // namespace

void serve_foxglove(const FoxgloveOptions& options, const std::function<bool()>& is_over) {
  end_on_foxglove_signals();
  FoxgloveSession session(options);
  fmt::print(stderr, "tactus foxglove: ws://{}:{}, for Foxglove and PlotJuggler; Ctrl-C ends\n",
             options.server.address, session.port());
  session.run(is_over);
}

}  // namespace tactus::host
