#include "hal/linux/gpio_lines.h"

#include <gpiod.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <memory>

#include "hal/linux/linux_gpio_chip.h"
#include "hal/linux/system.h"

namespace tactus::hal {

namespace {

// The size of the event buffer: libgpiod zeroes all of it in each read, so a larger one costs time.
constexpr std::size_t kEventsAtOnce = 64;

template <auto kFree>
// Deletes an object of libgpiod by its own function.
struct FreeWith {
  template <class T>
  void operator()(T* object) const {
    kFree(object);
  }
};
using LineSettings = std::unique_ptr<gpiod_line_settings, FreeWith<gpiod_line_settings_free>>;
using LineConfigs = std::unique_ptr<gpiod_line_config, FreeWith<gpiod_line_config_free>>;
using RequestConfig = std::unique_ptr<gpiod_request_config, FreeWith<gpiod_request_config_free>>;

gpiod_line_bias to_gpiod(GpioBias bias) {
  switch (bias) {
    case GpioBias::disabled:
      return GPIOD_LINE_BIAS_DISABLED;
    case GpioBias::pull_up:
      return GPIOD_LINE_BIAS_PULL_UP;
    case GpioBias::pull_down:
      return GPIOD_LINE_BIAS_PULL_DOWN;
    case GpioBias::as_is:
      break;
  }
  return GPIOD_LINE_BIAS_AS_IS;
}

gpiod_line_drive to_gpiod(GpioDrive drive) {
  switch (drive) {
    case GpioDrive::open_drain:
      return GPIOD_LINE_DRIVE_OPEN_DRAIN;
    case GpioDrive::open_source:
      return GPIOD_LINE_DRIVE_OPEN_SOURCE;
    case GpioDrive::push_pull:
      break;
  }
  return GPIOD_LINE_DRIVE_PUSH_PULL;
}

gpiod_line_edge to_gpiod(GpioEdges edges) {
  switch (edges) {
    case GpioEdges::rising:
      return GPIOD_LINE_EDGE_RISING;
    case GpioEdges::falling:
      return GPIOD_LINE_EDGE_FALLING;
    case GpioEdges::both:
      return GPIOD_LINE_EDGE_BOTH;
    case GpioEdges::none:
      break;
  }
  return GPIOD_LINE_EDGE_NONE;
}

gpiod_line_value to_gpiod(bool active) {
  return active ? GPIOD_LINE_VALUE_ACTIVE : GPIOD_LINE_VALUE_INACTIVE;
}

// Applies a line's configuration. The values are in range, so no setter can fail.
void apply(const GpioLineConfig& line, gpiod_line_settings* settings) {
  gpiod_line_settings_reset(settings);
  gpiod_line_settings_set_bias(settings, to_gpiod(line.bias));
  gpiod_line_settings_set_active_low(settings, line.active_low);
  if (line.direction == GpioDirection::output) {
    gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_OUTPUT);
    gpiod_line_settings_set_drive(settings, to_gpiod(line.drive));
    gpiod_line_settings_set_output_value(settings, to_gpiod(line.initial_active));
    return;
  }
  gpiod_line_settings_set_direction(settings, GPIOD_LINE_DIRECTION_INPUT);
  gpiod_line_settings_set_edge_detection(settings, to_gpiod(line.edges));
  gpiod_line_settings_set_debounce_period_us(settings, line.debounce_us);
  gpiod_line_settings_set_event_clock(settings, GPIOD_LINE_CLOCK_MONOTONIC);
}

// Returns true if both lines can be added by one call.
bool same_settings(const GpioLineConfig& a, const GpioLineConfig& b) {
  return a.direction == b.direction && a.bias == b.bias && a.active_low == b.active_low &&
         a.edges == b.edges && a.debounce_us == b.debounce_us && a.drive == b.drive &&
         a.initial_active == b.initial_active;
}

// Adds the lines in the order of the request, with one call for neighbours of equal settings.
Result<void> add_lines(std::span<const GpioLineConfig> lines, gpiod_line_config* configs) {
  const LineSettings settings(gpiod_line_settings_new());
  if (settings == nullptr) {
    return gpio_failure(errno);
  }
  std::array<unsigned, kMaxGpioLines> offsets;
  for (std::size_t first = 0; first < lines.size();) {
    std::size_t count = 0;
    while (first + count < lines.size() && same_settings(lines[first], lines[first + count])) {
      offsets[count] = lines[first + count].offset;
      ++count;
    }
    apply(lines[first], settings.get());
    if (gpiod_line_config_add_line_settings(configs, offsets.data(), count, settings.get()) != 0) {
      return gpio_failure(errno);
    }
    first += count;
  }
  return {};
}

Result<RequestConfig> to_gpiod(const GpioRequest& request) {
  RequestConfig config(gpiod_request_config_new());
  if (config == nullptr) {
    return gpio_failure(errno);
  }
  std::array<char, 32> consumer{};
  const auto length = std::min(request.consumer.size(), consumer.size() - 1);
  std::ranges::copy(request.consumer.substr(0, length), consumer.begin());
  gpiod_request_config_set_consumer(config.get(), consumer.data());
  gpiod_request_config_set_event_buffer_size(
      config.get(),
      request.edge_buffer != 0 ? request.edge_buffer : request.lines.size() * kGpioEdgesPerLine);
  return config;
}

}  // namespace

bool has_libgpiod() {
  return true;
}

LinuxGpioLines::~LinuxGpioLines() {
  release();
}

Result<void> LinuxGpioLines::DoRequest(const GpioRequest& request) {
  const auto chip = open_gpio_chip(chip_);
  if (!chip) {
    return std::unexpected(chip.error());
  }
  const std::size_t line_count = line_count_of(**chip);
  for (std::size_t i = 0; i < request.lines.size(); ++i) {
    if (request.lines[i].offset >= line_count) {
      return failure(ErrorCode::not_found);
    }
    offsets_[i] = request.lines[i].offset;
  }
  const LineConfigs configs(gpiod_line_config_new());
  if (configs == nullptr) {
    return gpio_failure(errno);
  }
  if (const auto added = add_lines(request.lines, configs.get()); !added) {
    return added;
  }
  const auto config = to_gpiod(request);
  if (!config) {
    return std::unexpected(config.error());
  }
  buffer_ = gpiod_edge_event_buffer_new(kEventsAtOnce);
  if (buffer_ == nullptr) {
    return gpio_failure(errno);
  }
  request_ = gpiod_chip_request_lines(chip->get(), config->get(), configs.get());
  if (request_ == nullptr) {
    const int why = errno;
    gpiod_edge_event_buffer_free(buffer_);
    buffer_ = nullptr;
    return gpio_failure(why);
  }
  return {};
}

void LinuxGpioLines::DoRelease() {
  gpiod_line_request_release(request_);
  gpiod_edge_event_buffer_free(buffer_);
  request_ = nullptr;
  buffer_ = nullptr;
}

std::size_t LinuxGpioLines::offsets_in(std::uint64_t mask,
                                       std::array<unsigned, kMaxGpioLines>& offsets) const {
  std::size_t count = 0;
  for (std::size_t i = 0; i < line_count(); ++i) {
    if ((mask >> i & 1U) != 0) {
      offsets[count] = offsets_[i];
      ++count;
    }
  }
  return count;
}

Result<std::uint64_t> LinuxGpioLines::DoGet(std::uint64_t mask) {
  std::array<unsigned, kMaxGpioLines> offsets;
  std::array<gpiod_line_value, kMaxGpioLines> levels;
  const std::size_t count = offsets_in(mask, offsets);
  if (gpiod_line_request_get_values_subset(request_, count, offsets.data(), levels.data()) != 0) {
    return gpio_failure(errno);
  }
  std::uint64_t values = 0;
  std::size_t next = 0;
  for (std::size_t i = 0; i < line_count(); ++i) {
    const std::uint64_t bit = std::uint64_t{1} << i;
    if ((mask & bit) != 0) {
      values |= levels[next] == GPIOD_LINE_VALUE_ACTIVE ? bit : 0;
      ++next;
    }
  }
  return values;
}

Result<void> LinuxGpioLines::DoSet(std::uint64_t mask, std::uint64_t values) {
  std::array<unsigned, kMaxGpioLines> offsets;
  std::array<gpiod_line_value, kMaxGpioLines> levels;
  const std::size_t count = offsets_in(mask, offsets);
  std::size_t next = 0;
  for (std::size_t i = 0; i < line_count(); ++i) {
    if ((mask >> i & 1U) != 0) {
      levels[next] = to_gpiod((values >> i & 1U) != 0);
      ++next;
    }
  }
  if (gpiod_line_request_set_values_subset(request_, count, offsets.data(), levels.data()) != 0) {
    return gpio_failure(errno);
  }
  return {};
}

Result<std::size_t> LinuxGpioLines::DoReadEdges(std::span<GpioEdgeEvent> events,
                                                TimeNs deadline_ns) {
  if (!wait_readable(gpiod_line_request_get_fd(request_), deadline_ns)) {
    return failure(ErrorCode::timeout);
  }
  const int count = gpiod_line_request_read_edge_events(request_, buffer_,
                                                        std::min(events.size(), kEventsAtOnce));
  if (count < 0) {
    return gpio_failure(errno);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    gpiod_edge_event* event = gpiod_edge_event_buffer_get_event(buffer_, i);
    events[i] = {
        .time_ns = static_cast<TimeNs>(gpiod_edge_event_get_timestamp_ns(event)),
        .offset = gpiod_edge_event_get_line_offset(event),
        .sequence = static_cast<std::uint32_t>(gpiod_edge_event_get_global_seqno(event)),
        .line_sequence = static_cast<std::uint32_t>(gpiod_edge_event_get_line_seqno(event)),
        .rising = gpiod_edge_event_get_event_type(event) == GPIOD_EDGE_EVENT_RISING_EDGE};
  }
  return static_cast<std::size_t>(count);
}

}  // namespace tactus::hal
