// The files that a run of tactusd starts from: the device's image, the scene's, the Falcon's
// firmware. Copied into memory and checked there before the loop: no later write
// reaches them. Nothing on the heap. What is wrong with one is told
// on stderr, with its name.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string_view>

#include "firmware/commands/scene_store.h"
#include "firmware/control/controller.h"
#include "firmware/device/device_image.h"
#include "firmware/tactusd/options.h"
#include "firmware/tactusd/messages.h"
#include "hal/linux/image_slot.h"

namespace tactus::firmware {

class RunInputs {
 public:
  // Configures the controller as the device's image and the command line say. False: told, and
  // nothing of use.
  bool load_device(const Options& options, Controller& controller);
  // The scene into the controller, if one is named; the same.
  bool load_scene(const Options& options, Controller& controller);
  // If the device names one; the same.
  bool load_falcon_firmware();

  // Why this device may not be enabled, and what to do; empty if it may.
  [[nodiscard]] std::string_view enable_refusal() const { return enable_refusal_; }
  // What the user does while the device is homed; empty: nothing.
  [[nodiscard]] std::string_view homing_hint() const { return homing_hint_; }
  [[nodiscard]] const DeviceConfig& config() const { return config_; }
  [[nodiscard]] std::span<const std::byte> device() const { return device_file_.bytes(); }
  [[nodiscard]] std::span<const std::byte> falcon_firmware() const { return falcon_file_.bytes(); }
  // Which the command thread changes later.
  [[nodiscard]] SceneStore& scenes() { return scenes_; }

 private:
  hal::ImageSlot device_file_;
  hal::ImageSlot falcon_file_;
  DeviceSections sections_;
  DeviceConfig config_;
  std::string_view enable_refusal_;
  std::array<char, kMaxMessage> homing_room_{};
  std::string_view homing_hint_;
  SceneStore scenes_;
};

}  // namespace tactus::firmware
