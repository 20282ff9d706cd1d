// Runs the portable part of a board's program on this machine, in this build's profile, and prints
// the lines that a board must print, too.
//   bare_metal_reference DEVICE.tactus SCENE.tactus TICKS
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string_view>

#include "firmware/bare_metal/held_handle.h"
#include "firmware/bare_metal/loaded_controller.h"
#include "firmware/bare_metal/session.h"
#include "hal/linux/mapped_file.h"

namespace {

tactus::firmware::LoadedController reference_controller;
tactus::firmware::HeldHandle reference_handle;

void print(const tactus::firmware::Line& line) {
  const std::string_view text = line.text();
  std::printf("%.*s\n", static_cast<int>(text.size()), text.data());
}

int run(std::span<char*> arguments) {
  tactus::hal::MappedFile device;
  tactus::hal::MappedFile scene;
  if (device.open(arguments[1]) != 0 || scene.open(arguments[2]) != 0) {
    std::fprintf(stderr, "bare_metal_reference: %s or %s cannot be read\n", arguments[1],
                 arguments[2]);
    return EXIT_FAILURE;
  }
  print(tactus::firmware::image_line(device.bytes(), scene.bytes()));
  const auto started = reference_controller.start(device.bytes(), scene.bytes());
  if (!started) {
    std::fprintf(stderr, "bare_metal_reference: %.*s\n",
                 static_cast<int>(started.error().what.size()), started.error().what.data());
    return EXIT_FAILURE;
  }
  reference_handle.start(reference_controller.device());
  tactus::firmware::Session session(reference_controller.controller(), reference_handle);
  const std::uint64_t ticks = std::strtoull(arguments[3], nullptr, 10);
  for (std::uint64_t i = 0; i < ticks; ++i) {
    session.tick(0, print);
  }
  return EXIT_SUCCESS;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::fputs("usage: bare_metal_reference DEVICE.tactus SCENE.tactus TICKS\n", stderr);
    return 2;
  }
  return run({arguments, static_cast<std::size_t>(count)});
}
