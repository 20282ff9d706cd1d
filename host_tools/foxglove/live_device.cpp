#include "host_tools/foxglove/live_device.h"

#include <ctime>
#include <utility>
#include <variant>

#include "hal/linux/system.h"
#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "rendering/limits.h"

namespace tactus::host {
namespace {

using std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr auto kBetweenAttempts = 1s;

// Returns the name of the link to a device's folder; its number if it has none.
std::string name_of_device(const std::filesystem::path& run_dir, std::size_t device) {
  std::error_code error;
  const std::filesystem::path names = run_dir / kNamesFolder;
  const std::filesystem::path folder = run_folder_of(run_dir, device);
  for (const auto& entry : std::filesystem::directory_iterator(names, error)) {
    std::error_code dangling;
    if (std::filesystem::equivalent(entry.path(), folder, dangling)) {
      return entry.path().filename().string();
    }
  }
  return std::to_string(device);
}

std::int64_t now_since_1970_ns() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return hal::to_ns(now);
}

// Returns the distance of a tick's clock from 1970. The clock is this machine's, or that of a board
// or of an emulator, whose ticks come at once.
std::int64_t clock_offset_ns(const firmware::RecordedTick& tick) {
  constexpr std::int64_t kLongestDelay_ns = 10 * hal::kNsPerSecond;
  const std::int64_t monotonic_ns = hal::monotonic_now_ns();
  const std::int64_t age_ns = monotonic_ns - tick.loop.scheduled_ns;
  const bool is_our_clock = age_ns >= 0 && age_ns < kLongestDelay_ns;
  return now_since_1970_ns() - (is_our_clock ? monotonic_ns : tick.loop.scheduled_ns);
}

}  // namespace

std::vector<DevicePlace> devices_in(const std::filesystem::path& run_dir) {
  std::vector<DevicePlace> devices;
  for (std::size_t number = 1; number <= rendering::kMaxTools; ++number) {
    const std::filesystem::path folder = run_folder_of(run_dir, number);
    std::error_code error;
    if (!std::filesystem::exists(folder / kLiveSocketFile, error)) {
      break;
    }
    devices.push_back({.name = name_of_device(run_dir, number), .folder = folder});
  }
  if (devices.size() == 1) {
    devices.front().name.clear();
  }
  return devices;
}

LiveDevice::LiveDevice(DevicePlace place) : place_(std::move(place)) {
  connect();
}

void LiveDevice::connect() {
  reader_.emplace((place_.folder / kLiveSocketFile).string());
  reader_->ask_for_places();
}

void LiveDevice::connect_again() {
  if (reader_ || steady_clock::now() < try_again_) {
    return;
  }
  try {
    connect();
  } catch (const InputError&) {
    try_again_ = steady_clock::now() + kBetweenAttempts;  // still nobody there
  }
}

void LiveDevice::take(const firmware::RecordedTick& tick) {
  if (!newest_ || tick.record.tick <= newest_->record.tick) {
    clock_offset_ns_ = clock_offset_ns(tick);
  }
  newest_ = tick;
}

bool LiveDevice::take_messages() {
  connect_again();
  bool is_other_scene = false;
  while (reader_) {
    const auto message = reader_->next(0ms);
    if (!message) {
      break;
    }
    if (const auto* tick = std::get_if<firmware::RecordedTick>(&*message)) {
      take(*tick);
    } else if (const auto* places = std::get_if<firmware::ObjectPlaces>(&*message)) {
      places_ = *places;
    } else if (const auto* event = std::get_if<firmware::TelemetryEvent>(&*message)) {
      is_other_scene = is_other_scene || event->kind == firmware::EventKind::scene;
    } else if (std::holds_alternative<RunInfo>(*message)) {
      is_other_scene = true;
    }
  }
  if (reader_ && reader_->ended()) {
    reader_.reset();
    try_again_ = steady_clock::now() + kBetweenAttempts;
  }
  return is_other_scene;
}

}  // namespace tactus::host
