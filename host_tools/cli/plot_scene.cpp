#include "host_tools/cli/plot_scene.h"

#include <fmt/format.h>

#include "host_tools/input_error.h"
#include "host_tools/plot/run_data.h"
#include "host_tools/recording/recording.h"

namespace tactus::host {

PlotScene::PlotScene(const std::string& scene, const std::string& run) {
  if (!scene.empty()) {
    file_.emplace(scene);
    return;
  }
  if (is_recording(run)) {
    const Recording recording(run);
    inside_ = SceneCopy(ImageCopy(recorded_scenes(recording).first), run + ": the scene's image");
  }
  if (inside_.scene() == nullptr) {
    throw InputError(
        fmt::format("{}: it has no scene inside; give its image: --scene scene.tactus", run));
  }
}

}  // namespace tactus::host
