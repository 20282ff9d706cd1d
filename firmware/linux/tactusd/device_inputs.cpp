#include "firmware/linux/tactusd/device_inputs.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "firmware/device_file/board_firmware.h"
#include "firmware/device_file/certificate_words.h"
#include "firmware/device_file/device_checks.h"
#include "firmware/device_file/device_commissioning.h"
#include "firmware/device_file/homing_words.h"

namespace tactus::firmware {
namespace {

// The longest path of the Falcon's firmware, with its zero.
constexpr std::size_t kMostPath = 512;

// A file larger than this is refused. Device images and the Falcon's firmware are far smaller.
constexpr std::size_t kMostBytes = std::size_t{16} << 20;

// Copies a file into the slot. Returns false after it has printed why to stderr.
bool copy(hal::ImageSlot& slot, const char* path) {
  const int no_room = slot.reserve(kMostBytes);
  const hal::FileError error =
      no_room == 0 ? slot.read(path) : hal::FileError{.what = "no memory", .errno_value = no_room};
  if (error.is_error()) {
    std::fprintf(stderr, "tactusd: %s: %.*s%s%s\n", path, length(error.what), error.what.data(),
                 error.errno_value != 0 ? ": " : "",
                 error.errno_value != 0 ? std::strerror(error.errno_value) : "");
  }
  return !error.is_error();
}

// The certificate was measured at the device's own rate, which its checksum covers. A wall that is
// held at that rate may not be held at a slower one; at a faster one it is held at least as well,
// because each force is held for less time and the delay, in ticks, is shorter.
bool is_slower_than_certified(const Options& options, const DeviceConfig& config) {
  return config.certification.limits.exists() && !options.allow_uncertified &&
         options.rate_hz > 0.0 && options.rate_hz < config.controller.rate_hz;
}

// Checks the rate given by --rate as baking checks the device's own rate. Returns false after it
// has printed why to stderr.
bool can_keep_rate(const Options& options, const char* path, const DeviceConfig& config) {
  Words words;
  const Verdict verdict = check_rates(config, words);
  if (!verdict) {
    const Refusal& refusal = verdict.error();
    const std::string_view name = refusal.place == Place::axis
                                      ? config.axes[refusal.index].name
                                      : config.connections[refusal.index].name;
    std::fprintf(stderr, "tactusd: %s: --rate %g: '%.*s': %.*s%s%.*s\n", path, options.rate_hz,
                 length(name), name.data(), length(refusal.key), refusal.key.data(),
                 refusal.key.empty() ? "" : " ", length(refusal.rule), refusal.rule.data());
  }
  return verdict.has_value();
}

}  // namespace

bool DeviceInputs::read_image(const Options& options, const char* path) {
  if (!copy(device_file_, path)) {
    return false;
  }
  auto outcome = open_device_image(device_file_.bytes(), sections_);
  if (outcome) {
    outcome = read_device(sections_, config_);
  }
  if (!outcome) {
    const DeviceError& error = outcome.error();
    std::fprintf(stderr, "tactusd: %s: %.*s%s%.*s\n", path, length(error.key), error.key.data(),
                 error.key.empty() ? "" : " ", length(error.what), error.what.data());
    return false;
  }
  if (is_slower_than_certified(options, config_)) {
    std::fprintf(stderr,
                 "tactusd: %s: the device is certified at %g Hz, and --rate %g is slower; leave "
                 "--rate out, or set rate_hz = %g under [controller], then tactus certify and "
                 "tactus bake, or take the risk with --allow-uncertified\n",
                 path, config_.controller.rate_hz, options.rate_hz, options.rate_hz);
    return false;
  }
  if (options.rate_hz > 0.0) {
    config_.controller.rate_hz = options.rate_hz;
    return can_keep_rate(options, path, config_);
  }
  return true;
}

bool DeviceInputs::take_proofs(const Options& options, const char* path) {
  std::array<char, kMaxMessage> words{};
  if (const auto warning = certificate_warning(config_.certification, words); !warning.empty()) {
    std::fprintf(stderr, "tactusd: %s: warning: %.*s\n", path, length(warning), warning.data());
  }
  const std::string_view refusal = commissioning_refusal(config_.commissioning);
  if (!refusal.empty()) {
    std::fprintf(stderr, "tactusd: %s: %s%.*s\n", path,
                 options.allow_uncommissioned ? "warning: " : "", length(refusal), refusal.data());
  }
  if (!options.allow_uncommissioned) {
    enable_refusal_ = refusal;
    return !options.enable || refusal.empty();
  }
  return true;
}

bool DeviceInputs::load(const Options& options, std::size_t number, Controller& controller) {
  const char* const path = options.devices[number];
  if (!read_image(options, path) || !take_proofs(options, path)) {
    return false;
  }
  homing_hint_.clear();
  add_homing_words(config_, homing_hint_);
  config_.controller.allow_uncertified = options.allow_uncertified;
  const auto valid = controller.configure(config_.controller, number);
  if (!valid) {
    const ConfigError& error = valid.error();
    // The image was found valid at the device's own rate, but for the certificate.
    std::fprintf(stderr, "tactusd: %s: %.*s is %g, not in %g to %g; %s\n", path,
                 length(error.field), error.field.data(), error.value, error.least, error.greatest,
                 error.field.starts_with("safety.workspace")
                     ? "lower it, then tactus certify and tactus bake, or take the risk with "
                       "--allow-uncertified"
                     : "give another --rate");
    return false;
  }
  return load_falcon_firmware();
}

bool DeviceInputs::load_falcon_firmware() {
  const std::string_view file = board_firmware_file(config_);
  if (file.empty()) {
    return true;
  }
  std::array<char, kMostPath> path{};
  std::memcpy(path.data(), file.data(), std::min(file.size(), path.size() - 1));
  return copy(falcon_file_, path.data());
}

}  // namespace tactus::firmware
