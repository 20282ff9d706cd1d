#include "firmware/linux/flight/flight_file.h"

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <ctime>

#include "firmware/linux/flight/attachments.h"
#include "firmware/linux/telemetry/text_buffer.h"
#include "rendering/scene/image_format.h"

namespace tactus::firmware {

void FlightFile::plan(const FlightPlan& plan) {
  plan_ = plan;
  images_ = {};
  for (const Attachment& image :
       plan.images.first(std::min(plan.images.size(), AttachmentList::kMost - 1))) {
    images_.set(image);
  }
  info_count_ = std::min(plan.run.info.size(), kMaxInfo - 2);
  std::ranges::copy(plan.run.info.first(info_count_), info_.begin());
}

void FlightFile::use_scene(std::span<const std::byte> image) {
  images_.set(attachment_of(kSceneAttachment, image));

  const auto tells_scene = [](const MetadataEntry& entry) {
    return entry.key == kSceneChecksumKey || entry.key == kSceneFileKey;
  };
  const auto known = std::span(info_).first(info_count_);
  info_count_ -= std::ranges::remove_if(known, tells_scene).size();
  TextBuffer checksum(scene_checksum_);
  checksum.hex(rendering::header_checksum(image));
  info_[info_count_] = {.key = kSceneChecksumKey,
                        .value = {scene_checksum_.data(), checksum.size()}};
  ++info_count_;
}

void FlightFile::name(std::time_t now, std::uint64_t tick) {
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 32> time{};
  std::strftime(time.data(), time.size(), "%Y%m%dT%H%M%SZ", &utc);
  std::array<char, 16> device{};
  if (plan_.device > 0) {
    std::snprintf(device.data(), device.size(), ".%zu", plan_.device + 1);
  }
  std::snprintf(path_.data(), path_.size(), "%s/flight-%s-%" PRIu64 "%s.mcap", plan_.folder,
                time.data(), tick, device.data());
}

WrittenFlight FlightFile::write(const FlightWindow& window, const FlightTicks& ticks,
                                std::time_t now) {
  name(now, window.end_tick);
  if (const int failed = file_.open(path_.data(), plan_.run.clock_offset_ns,
                                    std::span(info_).first(info_count_), IfThere::refuse);
      failed != 0) {
    return {.failed = failed};
  }
  for (const Attachment& image : images_.all()) {
    if (!image.bytes.empty()) {
      file_.attach(image);
    }
  }
  if (!window.state.empty()) {
    file_.attach({.name = kStateAttachment, .bytes = window.state});
  }
  std::uint64_t end = window.first_tick;
  RecordedTick tick;
  while (end < window.end_tick && ticks.read(end, tick)) {
    file_.add(tick);
    ++end;
  }
  return {.failed = file_.close(), .ticks = end - window.first_tick};
}

}  // namespace tactus::firmware
