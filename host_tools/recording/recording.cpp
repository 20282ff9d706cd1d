#include "host_tools/recording/recording.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>

#include "firmware/linux/telemetry/mcap_writer.h"
#include "hal/linux/system.h"
#include "host_tools/input_error.h"
#include "host_tools/recording/record_decoder.h"

namespace tactus::host {
namespace {

// Maps a file for reading, so that a recording of any size needs no memory of its own. Throws
// InputError.
std::span<const std::byte> map_file(const std::string& name) {
  // The variadic interface of open has no other form.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg)
  const hal::FileDescriptor file(::open(name.c_str(), O_RDONLY | O_CLOEXEC));
  struct stat status{};
  if (!file.is_open() || fstat(file.get(), &status) != 0) {
    throw InputError(name + ": cannot read: " + std::strerror(errno));
  }
  if (!S_ISREG(status.st_mode) || status.st_size == 0) {
    throw InputError(name + ": this is not a recording: it is empty or no file");
  }
  const auto size = static_cast<std::size_t>(status.st_size);
  void* memory = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (memory == MAP_FAILED) {
    throw InputError(name + ": cannot read: " + std::strerror(errno));
  }
  return {static_cast<const std::byte*>(memory), size};
}

void unmap_file(std::span<const std::byte> bytes) {
  // The interface of munmap takes what mmap gave, which was never written to.
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  munmap(const_cast<std::byte*>(bytes.data()), bytes.size());
}

}  // namespace

Recording::Recording(const std::string& file) : name_(file), bytes_(map_file(file)) {
  try {
    reader_ = std::make_unique<McapReader>(bytes_);
    const auto info = reader_->metadata().find(firmware::kMetadataName);
    if (info == reader_->metadata().end()) {
      throw InputError("this MCAP file is no recording of tactusd or tactus sim");
    }
    info_ = info->second;
    read_events();
  } catch (const InputError& error) {
    unmap_file(bytes_);
    throw InputError(name_ + ": " + error.what());
  }
}

Recording::~Recording() {
  unmap_file(bytes_);
}

void Recording::read_events() {
  while (const auto message = reader_->next()) {
    if (message->topic != firmware::kEventTopic) {
      continue;
    }
    const auto event = decode_event(message->data);
    if (!event) {
      throw InputError("an event is damaged");
    }
    // The writer interleaves events with ticks of other times; equal ticks keep the file's order.
    const auto after =
        std::ranges::upper_bound(events_, event->tick, {}, &firmware::TelemetryEvent::tick);
    events_.insert(after, *event);
  }
  reader_->rewind();
}

std::optional<firmware::RecordedTick> Recording::next() {
  try {
    while (const auto message = reader_->next()) {
      if (message->topic != firmware::kTickTopic) {
        continue;
      }
      auto tick = decode_tick(message->data);
      if (!tick) {
        throw InputError("tick message " + std::to_string(message->sequence) +
                         " is damaged, or of a newer version");
      }
      return tick;
    }
  } catch (const InputError& error) {
    throw InputError(name_ + ": " + error.what());
  }
  return std::nullopt;
}

std::optional<firmware::Explanation> Recording::next_explanation() {
  try {
    if (explanations_ == nullptr) {
      explanations_ = std::make_unique<McapReader>(bytes_);
    }
    while (const auto message = explanations_->next()) {
      if (message->topic != firmware::kExplanationTopic) {
        continue;
      }
      const auto explanation = decode_explanation(message->data);
      if (!explanation) {
        throw InputError("explanation message " + std::to_string(message->sequence) +
                         " is damaged, or of a newer version");
      }
      return explanation;
    }
  } catch (const InputError& error) {
    throw InputError(name_ + ": " + error.what());
  }
  return std::nullopt;
}

void Recording::rewind() {
  reader_->rewind();
  explanations_.reset();
}

std::string_view Recording::info(std::string_view key) const {
  const auto found = info_.find(key);
  return found != info_.end() ? std::string_view(found->second) : std::string_view{};
}

std::span<const std::span<const std::byte>> Recording::attachments(std::string_view name) const {
  const auto found = reader_->attachments().find(name);
  if (found == reader_->attachments().end()) {
    return {};
  }
  return found->second;
}

std::span<const std::byte> Recording::attachment(std::string_view name) const {
  const auto found = attachments(name);
  return found.empty() ? std::span<const std::byte>{} : found.front();
}

}  // namespace tactus::host
