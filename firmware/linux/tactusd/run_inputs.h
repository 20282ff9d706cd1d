// The files that a run of tactusd starts from: the device image, the scene image and the Falcon's
// firmware. Each is copied into memory and checked there before the loop, so that a later write to
// the file has no effect. Nothing is on the heap.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "drivers/common/words.h"
#include "firmware/control/controller.h"
#include "firmware/device_file/device_image.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/tactusd/messages.h"
#include "firmware/linux/tactusd/options.h"
#include "hal/linux/image_slot.h"

namespace tactus::firmware {

// The inputs of one run, in static storage. Not real time; one thread.
class RunInputs {
 public:
  // Each load function returns false after it has printed the file and the reason to stderr.

  // Configures the controller as the device image and the command line say. Each load function
  // returns false after it has printed the file and the reason to stderr.
  bool load_device(const Options& options, Controller& controller);
  // Loads the scene into the controller, if the command line names one.
  bool load_scene(const Options& options, Controller& controller);
  // Loads the Falcon's firmware, if the device names a file.
  bool load_falcon_firmware();

  // Returns why this device may not be enabled and what to do; empty if it may.
  [[nodiscard]] std::string_view enable_refusal() const { return enable_refusal_; }
  // Returns what the user has to do while the device homes; empty if nothing.
  [[nodiscard]] std::string_view homing_hint() const { return homing_hint_.view(); }
  // Returns the device's configuration, with --rate and --allow-uncertified.
  [[nodiscard]] const DeviceConfig& config() const { return config_; }
  // Return the bytes of the device image and of the Falcon's firmware; empty without one.
  [[nodiscard]] std::span<const std::byte> device() const { return device_file_.bytes(); }
  [[nodiscard]] std::span<const std::byte> falcon_firmware() const { return falcon_file_.bytes(); }
  // Returns the scene's memory. The command thread uses it once the loop runs.
  [[nodiscard]] SceneStore& scenes() { return scenes_; }

 private:
  hal::ImageSlot device_file_;
  hal::ImageSlot falcon_file_;
  DeviceSections sections_;
  DeviceConfig config_;
  std::string_view enable_refusal_;
  Words homing_hint_;
  SceneStore scenes_;
};

}  // namespace tactus::firmware
