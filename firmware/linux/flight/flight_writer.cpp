#include "firmware/linux/flight/flight_writer.h"

#include <unistd.h>

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/text_buffer.h"

namespace tactus::firmware {

int FlightWriter::start(const FlightPlan& plan) {
  plan_ = plan;
  copy_plan();
  tzset();  // or gmtime_r asks for memory when it is first called
  return thread_.start("flight", [](void* self) { static_cast<FlightWriter*>(self)->run(); }, this);
}

void FlightWriter::copy_plan() {
  images_ = {};
  for (const Attachment& image :
       plan_.images.first(std::min(plan_.images.size(), AttachmentList::kMost - 1))) {
    images_.set(image);
  }
  info_count_ = std::min(plan_.run.info.size(), kMaxInfo - 2);
  std::ranges::copy(plan_.run.info.first(info_count_), info_.begin());
}

void FlightWriter::use_scene(std::span<const std::byte> image) {
  const std::scoped_lock lock(plan_mutex_);
  images_.set(attachment_of(kSceneAttachment, image));

  const auto tells_scene = [](const MetadataEntry& entry) {
    return entry.key == kSceneChecksumKey || entry.key == kSceneFileKey;
  };
  const auto known = std::span(info_).first(info_count_);
  info_count_ -= std::ranges::remove_if(known, tells_scene).size();
  TextBuffer checksum(scene_checksum_);
  checksum.hex(checksum_of(image));
  info_[info_count_] = {.key = kSceneChecksumKey,
                        .value = {scene_checksum_.data(), checksum.size()}};
  ++info_count_;
  has_scene_.store(true, std::memory_order_release);
}

void FlightWriter::add(const RecordedTick& tick, Controller& controller) {
  recorder_.add(tick, controller);
  const Mode mode = tick.record.mode;
  if (mode == Mode::fault && mode_ != Mode::fault) {
    ticks_to_wait_ = static_cast<std::uint64_t>(kAfterFault_s * plan_.rate_hz) + 1;
    waiting_.store(true, std::memory_order_release);
  }
  mode_ = mode;
  if (ticks_to_wait_ == 0) {
    return;
  }
  --ticks_to_wait_;
  if (ticks_to_wait_ == 0) {
    waiting_.store(false, std::memory_order_release);
    ask();
  }
}

void FlightWriter::stop() {
  stopping_.store(true, std::memory_order_release);
  thread_.join();
}

void FlightWriter::run() {
  // The interval at which the thread looks for a wanted file.
  constexpr useconds_t kLook_us = 20'000;
  bool stopping = false;
  while (!stopping) {
    stopping = stopping_.load(std::memory_order_acquire);
    const bool fault = stopping && waiting_.load(std::memory_order_acquire);
    const bool ready = has_scene_.load(std::memory_order_acquire);
    if (ready && (wanted_.exchange(false, std::memory_order_acq_rel) || fault)) {
      write_out();
    }
    if (!stopping) {
      usleep(kLook_us);
    }
  }
}

void FlightWriter::write_out() {
  const std::scoped_lock lock(plan_mutex_);
  constexpr int kTries = 3;  // a slow disk may be overtaken by the loop
  for (int k = 0; k < kTries; ++k) {
    const auto window = recorder_.hold();
    if (!has_scene_.load(std::memory_order_acquire)) {
      ask();  // the loop has just changed the scene
      break;
    }
    if (!window || window->first_tick == window->end_tick) {
      std::fputs("tactusd: the flight recorder has nothing yet\n", stderr);
      break;
    }
    std::uint64_t first = 0;
    std::uint64_t end = 0;
    const int failed = write_file(*window, first, end);
    if (failed != 0) {
      std::fprintf(stderr, "tactusd: %s: cannot write: %s\n", path_.data(), std::strerror(failed));
      break;
    }
    if (end > first) {
      files_.fetch_add(1, std::memory_order_release);
      std::fprintf(stderr, "tactusd: %s has the last %.1f s; tactus replay shows them\n",
                   path_.data(), static_cast<double>(end - first) / plan_.rate_hz);
      break;
    }
  }
  recorder_.release();
}

void FlightWriter::name_file(std::uint64_t tick) {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> time{};
  std::strftime(time.data(), time.size(), "%Y%m%dT%H%M%SZ", &utc);
  std::snprintf(path_.data(), path_.size(), "%s/flight-%s-%" PRIu64 ".mcap", plan_.folder,
                time.data(), tick);
}

// Writes the window to a file. The file then holds the ticks from `first` to one before `end`.
// Returns 0 or errno.
int FlightWriter::write_file(const FlightWindow& window, std::uint64_t& first, std::uint64_t& end) {
  name_file(window.end_tick);
  if (const int failed = file_.open(path_.data(), plan_.run.clock_offset_ns,
                                    std::span(info_).first(info_count_), IfThere::refuse);
      failed != 0) {
    return failed;
  }
  for (const Attachment& image : images_.all()) {
    if (!image.bytes.empty()) {
      file_.attach(image);
    }
  }
  file_.attach({.name = kStateAttachment, .bytes = window.state});
  first = end = window.first_tick;
  RecordedTick tick;
  while (end < window.end_tick && recorder_.read(end, tick)) {
    file_.add(tick);
    ++end;
  }
  return file_.close();
}

}  // namespace tactus::firmware
