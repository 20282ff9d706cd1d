// The files that a device of a run of tactusd starts from: its image and the Falcon's firmware.
// Each is copied into memory and checked there before the loop, so that a later write to the file
// has no effect. Nothing is on the heap.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "drivers/common/words.h"
#include "firmware/control/controller.h"
#include "firmware/device_file/device_image.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/options.h"
#include "hal/linux/image_slot.h"

namespace tactus::firmware {

// The inputs of one device, in static storage. Not real time; one thread.
class DeviceInputs {
 public:
  // Reads the image of the device of that number, 0 for the first, and configures the controller's
  // device as it and the command line say. Reads the Falcon's firmware too, if the image names a
  // file. Returns false after it has printed the file and the reason to stderr.
  bool load(const Options& options, std::size_t number, Controller& controller);

  // Returns why this device may not be enabled and what to do; empty if it may.
  [[nodiscard]] std::string_view enable_refusal() const { return enable_refusal_; }
  // Returns what the user has to do while the device homes; empty if nothing.
  [[nodiscard]] std::string_view homing_hint() const { return homing_hint_.view(); }
  // Returns the device's configuration, with --rate and --allow-uncertified.
  [[nodiscard]] const DeviceConfig& config() const { return config_; }
  // Return the bytes of the device image and of the Falcon's firmware; empty without one.
  [[nodiscard]] std::span<const std::byte> device() const { return device_file_.bytes(); }
  [[nodiscard]] std::span<const std::byte> falcon_firmware() const { return falcon_file_.bytes(); }

 private:
  // Each of these returns false after it has printed why to stderr.

  // Reads the image into config_, at the rate of the command line.
  bool read_image(const Options& options, const char* path);
  // Takes what the image says of certificate and commissioning.
  bool take_proofs(const Options& options, const char* path);
  bool load_falcon_firmware();

  hal::ImageSlot device_file_;
  hal::ImageSlot falcon_file_;
  DeviceSections sections_;
  DeviceConfig config_;
  std::string_view enable_refusal_;
  Words homing_hint_;
};

}  // namespace tactus::firmware
