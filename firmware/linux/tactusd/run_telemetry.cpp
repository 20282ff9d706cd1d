#include "firmware/linux/tactusd/run_telemetry.h"

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "firmware/configuration/config_state.h"
#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/tactusd/run_folder.h"
#include "hal/linux/system.h"

namespace tactus::firmware {
namespace {

constexpr std::string_view kLiveSocketName = "/telemetry.sock";
// PlotJuggler draws a hundred points a second.
constexpr double kUdpRate_Hz = 100.0;

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

bool RunTelemetry::start(const Options& options, const RunImages& images, std::size_t joints) {
  describe(options, images, joints);
  attach(images);
  if (!open_live_socket(options)) {
    return false;
  }
  if (options.udp_port != 0) {
    const auto every = static_cast<std::uint32_t>(images.config.rate_hz / kUdpRate_Hz);
    if (!succeeds("--udp-json", writer_.open_udp(options.udp_port, every))) {
      return false;
    }
  }
  if (options.record != nullptr && !succeeds(options.record, writer_.record(options.record))) {
    return false;
  }
  return succeeds("no thread for telemetry", writer_.start()) &&
         succeeds("no thread for the flight recorder",
                  flight_.start({.folder = options.flight_dir,
                                 .rate_hz = images.config.rate_hz,
                                 .run = description_,
                                 .images = images_}));
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
    return keep([&](TextBuffer& text) { text.hex(checksum_of(image)); });
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
  note("device.file", options.device);
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

void RunTelemetry::attach(const RunImages& images) {
  std::size_t count = 0;
  const std::size_t config_bytes = save_config(images.config, config_);
  for (const Attachment& image :
       {attachment_of(kConfigAttachment, std::span(config_).first(config_bytes)),
        attachment_of(kDeviceAttachment, images.device),
        attachment_of(kSceneAttachment, images.scene)}) {
    if (!image.bytes.empty()) {
      writer_.attach(image);
      images_[count++] = image;
    }
  }
}

bool RunTelemetry::open_live_socket(const Options& options) {
  std::array<char, 256> path{};
  TextBuffer text{std::span(path).first(path.size() - 1)};
  text.text(run_folder(options)).text(kLiveSocketName);
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
      .record = controller.record(),
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
  flight_.add(recorded, controller);
  writer_.publish(recorded);
  explanations_.after_tick(controller, tick.scheduled_ns, writer_);
}

void RunTelemetry::stop(const Options& options) {
  flight_.stop();
  const int failed = writer_.stop();
  const char* const record = options.record != nullptr ? options.record : "recording";
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
