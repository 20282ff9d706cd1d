#include "host_tools/touch/tool_record.h"

namespace tactus::host {

ToolRecord::ToolRecord(const ToolFiles& files, double tool_radius_m)
    : rows_(files.rows), explainer_(tool_radius_m) {
  if (!files.steps.empty()) {
    steps_.emplace(files.steps);
  }
  if (!files.hashes.empty()) {
    hashes_.emplace(files.hashes);
  }
}

rendering::TickWatcher* ToolRecord::begin() {
  explainer_.begin();
  return steps_ ? &explainer_ : nullptr;
}

void ToolRecord::add(std::size_t tick, double t_s, const rendering::ToolState& tool,
                     const rendering::Touch& touch) {
  if (steps_) {
    steps_->add(explainer_.finish(tick, t_s, tool.p_W, touch));
  }
  if (hashes_) {
    hashes_->add(hash_.add(tick, t_s, tool, touch));
  }
  rows_.add(t_s, tool.p_W, touch);
  summary_.add(touch);
}

void ToolRecord::close() {
  rows_.close();
  if (steps_) {
    steps_->close();
  }
  if (hashes_) {
    hashes_->close();
  }
}

}  // namespace tactus::host
