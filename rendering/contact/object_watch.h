// Who sees the steps of an independent contact: the watcher of the tick (tick_watcher.h) with the
// object that is touched.
#pragma once

#include <cstdint>

namespace tactus::rendering {

class TickWatcher;
struct Mover;
struct Object;

// The watcher of a tick and the object; no watcher by default.
struct ObjectWatch {
  TickWatcher* watcher = nullptr;
  // The number of the object in the scene, and the object itself.
  std::uint32_t number = 0;
  const Object* object = nullptr;
  // The object's place if it moves; nullptr if it is fixed.
  const Mover* mover = nullptr;
};

}  // namespace tactus::rendering
