// The scene that a run of tactusd starts with. Not real time; one thread.
#pragma once

#include "firmware/control/controller.h"
#include "firmware/linux/commands/scene_store.h"
#include "firmware/linux/tactusd/options.h"

namespace tactus::firmware {

// Loads the scene that the command line names into the controller, whose devices are configured;
// without one nothing is loaded. The store owns the scene's memory. Returns false after it has
// printed the file and the reason to stderr.
bool load_scene(const Options& options, SceneStore& scenes, Controller& controller);

}  // namespace tactus::firmware
