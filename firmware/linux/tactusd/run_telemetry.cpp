#include "firmware/linux/tactusd/run_telemetry.h"

#include <algorithm>
#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/tactusd/run_folder.h"
#include "hal/linux/system.h"
#include "rendering/scene/image_format.h"

namespace tactus::firmware {
namespace {

constexpr std::string_view kLiveSocketName = "/telemetry.sock";

// Returns CLOCK_REALTIME minus CLOCK_MONOTONIC, ns: a recording's times are since 1970.
std::int64_t realtime_offset_ns() {
  timespec now{};
  clock_gettime(CLOCK_REALTIME, &now);
  return hal::to_ns(now) - hal::monotonic_now_ns();
}

// Returns true if `failed` is 0; otherwise prints `what` and the error to stderr.
bool succeeds(const char* what, int failed) {
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: %s: %s\n", what, std::strerror(failed));
  }
  return failed == 0;
}

}  // namespace

bool RunTelemetry::start(const Options& options, std::size_t device, const RunImages& images,
                         std::size_t joints) {
  device_ = device;
  rate_hz_ = images.config.rate_hz;
  explanations_.set_device(device);
  describe(options, images, joints);
  attach(images);
  return open_live_socket(options) && open_udp(options, rate_hz_) && open_recording(options) &&
         succeeds("no thread for telemetry", writer_.start());
}

bool RunTelemetry::open_udp(const Options& options, double rate_hz) {
  if (options.udp_port == 0) {
    return true;
  }
  const auto port = static_cast<std::uint16_t>(options.udp_port + device_);
  return succeeds("--udp-json", writer_.open_udp(port, rate_hz));
}

bool RunTelemetry::open_recording(const Options& options) {
  if (options.record == nullptr) {
    return true;
  }
  const std::string_view path(options.record);
  const std::size_t dot = std::min(path.rfind('.'), path.size());
  const std::string_view stem = path.substr(0, dot);
  const std::string_view ending = path.substr(dot);
  TextBuffer text{std::span(record_).first(record_.size() - 1)};
  text.text(stem);
  if (device_ > 0) {
    text.text(".").number(device_ + 1);
  }
  text.text(ending);
  const int failed =
      writer_.record(record_.data(), options.overwrite ? IfThere::replace : IfThere::refuse);
  if (failed == EEXIST) {
    std::fprintf(stderr,
                 "tactusd: %s: this file is there and is kept; name another, or say --overwrite\n",
                 record_.data());
    return false;
  }
  return succeeds(record_.data(), failed);
}

FlightPlan RunTelemetry::flight_plan(const Options& options) const {
  return {.folder = options.flight_dir,
          .device = device_,
          .rate_hz = rate_hz_,
          .run = description_,
          .images = std::span(images_).first(image_count_)};
}

template <class Write>
std::string_view RunTelemetry::keep(Write write) {
  const std::size_t begin = texts_.size();
  write(texts_);
  const auto written = texts_.written().subspan(begin);
  return {written.data(), written.size()};
}

void RunTelemetry::note(std::string_view key, std::string_view value) {
  if (info_count_ < info_.size()) {
    info_[info_count_] = {.key = key, .value = value};
    ++info_count_;
  }
}

void RunTelemetry::describe(const Options& options, const RunImages& images, std::size_t joints) {
  const auto checksum = [&](std::span<const std::byte> image) {
    return keep([&](TextBuffer& text) { text.hex(rendering::header_checksum(image)); });
  };
  note("program", "tactusd");
  note("version", TACTUS_VERSION);
  note("rate_hz", keep([&](TextBuffer& text) { text.number(images.config.rate_hz); }));
  note("joints", keep([&](TextBuffer& text) { text.number(joints); }));
  note("started", keep([](TextBuffer& text) {
         const std::time_t now = std::time(nullptr);
         std::tm utc{};
         gmtime_r(&now, &utc);
         std::array<char, 32> written{};
         const std::size_t size =
             std::strftime(written.data(), written.size(), "%Y-%m-%dT%H:%M:%SZ", &utc);
         text.text({written.data(), size});
       }));
  note("device.file", options.devices[device_]);
  describe_device(options);
  note(kDeviceChecksumKey, checksum(images.device));
  if (!images.scene.empty()) {
    note(kSceneFileKey, options.scene);
    note(kSceneChecksumKey, checksum(images.scene));
  }
  description_ = {.info = std::span(info_).first(info_count_),
                  .joints = joints,
                  .clock_offset_ns = realtime_offset_ns()};
  writer_.describe(description_);
}

void RunTelemetry::describe_device(const Options& options) {
  if (options.device_count > 1) {
    note(kDeviceNumberKey, keep([&](TextBuffer& text) { text.number(device_ + 1); }));
    note(kDeviceCountKey, keep([&](TextBuffer& text) { text.number(options.device_count); }));
  }
}

void RunTelemetry::attach(const RunImages& images) {
  const std::size_t config_bytes = save_config(images.config, config_);
  for (const Attachment& image :
       {attachment_of(kConfigAttachment, std::span(config_).first(config_bytes)),
        attachment_of(kDeviceAttachment, images.device),
        attachment_of(kSceneAttachment, images.scene)}) {
    if (!image.bytes.empty()) {
      writer_.attach(image);
      images_[image_count_++] = image;
    }
  }
}

bool RunTelemetry::open_live_socket(const Options& options) {
  std::array<char, 256> path{};
  TextBuffer text{std::span(path).first(path.size() - 1)};
  text.text(run_folder(options, device_).data()).text(kLiveSocketName);
  const int failed = writer_.open_live_socket(path.data());
  if (failed == 0) {
    return true;
  }
  std::fprintf(stderr, "tactusd: no live telemetry: %s: %s; --run-dir names another folder\n",
               path.data(), std::strerror(failed));
  return false;
}

void RunTelemetry::publish(Controller& controller, const LoopTick& tick,
                           const drivers::ComposedDevice& device) {
  RecordedTick recorded{
      .record = controller.record(device_),
      .loop = {.scheduled_ns = tick.scheduled_ns,
               .woke_ns = tick.woke_ns,
               .done_ns = tick.done_ns,
               .sample_ns = device.encoder_sample(0).time_ns},
      .joint_count = static_cast<std::uint32_t>(device.joint_count()),
  };
  for (std::size_t i = 0; i < device.joint_count(); ++i) {
    recorded.shaft_rad[i] = device.encoder_sample(i).position_rad;
    recorded.torque_Nm[i] = device.commanded_torque_Nm(i);
  }
  if (companion_ != nullptr) {
    companion_->ticks.add(recorded);
  } else if (sinks_.flight != nullptr) {
    sinks_.flight->add(recorded, controller);
  }
  writer_.publish(recorded);
  explanations_.after_tick(controller, tick.scheduled_ns, writer_);
  places_.after_tick(controller, tick.scheduled_ns, writer_);
}

void RunTelemetry::stop() {
  const int failed = writer_.stop();
  const char* const record = record_.front() != '\0' ? record_.data() : "recording";
  if (failed != 0) {
    std::fprintf(stderr, "tactusd: %s: ended early: %s; what came before is in it\n", record,
                 std::strerror(failed));
  }
  if (writer_.dropped_ticks() > 0) {
    std::fprintf(stderr,
                 "tactusd: telemetry was too slow: %" PRIu64
                 " ticks are missing from what was "
                 "recorded and shown\n",
                 writer_.dropped_ticks());
  }
}

}  // namespace tactus::firmware
