#include "host_tools/serial/line_telemetry.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <chrono>
#include <cstring>
#include <ctime>
#include <thread>
#include <utility>

#include "firmware/linux/flight/attachments.h"
#include "hal/linux/system.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/live_reader.h"

namespace tactus::host {
namespace {

// The writer's ring has room for several times as many ticks, and its thread looks every few
// milliseconds.
constexpr std::size_t kTicksAtATime = 512;

// Throws InputError for an errno other than 0.
void require(int error, const std::string& what) {
  if (error != 0) {
    throw InputError(fmt::format("{}: {}", what, std::strerror(error)));
  }
}

}  // namespace

void LineTelemetry::note(std::string_view key, std::string value) {
  words_.push_back(std::move(value));
  info_[info_count_] = {.key = key, .value = words_.back()};
  ++info_count_;
}

void LineTelemetry::describe(const firmware::Hello& board, const KnownImages& images) {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  note("program", "tactus line");
  note("device", std::string(firmware::text_of(board.board)));
  note("profile", std::string(firmware::text_of(board.profile)));
  note("rate_hz", fmt::format("{}", board.rate_hz));
  note("joints", fmt::format("{}", board.joints));
  note("started", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(now.tv_sec)));
  note(firmware::kDeviceChecksumKey, fmt::format("{:016x}", board.device.checksum));
  note(firmware::kSceneChecksumKey, fmt::format("{:016x}", board.scene.checksum));
  // The board's clock begins with its ticks, within the time that its start takes.
  const auto board_ns =
      static_cast<std::int64_t>(static_cast<double>(board.next_tick) / board.rate_hz * 1e9);
  writer_->describe({.info = std::span(info_).first(info_count_),
                     .joints = board.joints,
                     .clock_offset_ns = hal::to_ns(now) - board_ns});
  for (const firmware::Attachment& image :
       {firmware::attachment_of(firmware::kDeviceAttachment, images.device),
        firmware::attachment_of(firmware::kSceneAttachment, images.scene)}) {
    if (!image.bytes.empty()) {
      writer_->attach(image);
    }
  }
}

void LineTelemetry::start(const firmware::Hello& board, const KnownImages& images,
                          const std::filesystem::path& folder, const std::string& record) {
  const std::string socket = (folder / kLiveSocketFile).string();
  require(writer_->open_live_socket(socket.c_str()), socket);
  describe(board, images);
  if (!record.empty()) {
    require(writer_->record(record.c_str()), record);
  }
  require(writer_->start(), "no thread for telemetry");
  is_started_ = true;
}

void LineTelemetry::add(const firmware::RecordedTick& tick) {
  waiting_.push_back(tick);
  first_tick_ = ticks_ == 0 ? tick.record.tick : first_tick_;
  ++ticks_;
  last_tick_ = tick.record.tick;
}

void LineTelemetry::pass_on() {
  for (std::size_t i = 0; is_started_ && i < kTicksAtATime && !waiting_.empty(); ++i) {
    writer_->publish_relayed(waiting_.front());
    waiting_.pop_front();
  }
}

void LineTelemetry::stop() {
  while (is_started_ && !waiting_.empty()) {
    pass_on();
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  require(writer_->stop(), "the recording ended early");
}

}  // namespace tactus::host
