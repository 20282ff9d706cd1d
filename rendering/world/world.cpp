#include "rendering/world/world.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "rendering/contact/tick_watcher.h"

namespace tactus::rendering {

namespace {

// Returns the cost units of so many effects on each of the tools.
constexpr std::size_t effect_units(std::size_t effects, std::size_t tools) {
  return kCostOfEffect * effects * tools;
}

// Returns the laws of bodies; the yield of a soft finger is 3 R / (4 E*).
BodyLaws laws_of(const WorldConfig& config) {
  const double modulus_Pa = config.soft_finger_modulus_Pa;
  return {
      .gravity_W = config.gravity_W,
      .finger_yield_m3_per_N = modulus_Pa > 0.0 ? 0.75 * config.tool_radius_m / modulus_Pa : 0.0,
      .sleep_after_s = config.sleep_after_s};
}

// The watch of what a world of several tools does for all of them.
struct ManyWatched {
  std::span<TickWatcher* const> watchers;

  void see_step(TickStep step) const {
    for (TickWatcher* const watcher : watchers) {
      if (watcher != nullptr) {
        watcher->see_step(step);
      }
    }
  }
};

}  // namespace

std::size_t standing_units(std::span<const Object> objects, const WorldConfig& config) {
  return needs_of(objects).motion_units() + effect_units(config.effects.size(), config.tool_count);
}

SceneCounts scene_counts(std::span<const Object> objects, const WorldConfig& config) {
  SceneCounts counts = needs_of(objects).counts();
  counts.tools = config.tool_count;
  for (const ObjectBody& body : config.bodies) {
    counts.parts_of_body = std::max<std::size_t>(counts.parts_of_body, body.part_count);
  }
  counts.body_parts = config.body_parts.size();
  counts.effects = config.effects.size();
  counts.tissues = config.needle.tissues.size();
  return counts;
}

// All tools start again, also after a refusal: the world is then empty and gives no force.
bool World::set_scene(std::span<const Object> objects, const WorldConfig& config) {
  const bool good_config =
      !first_exceeded(scene_counts(objects, config), kProfile) &&
      is_tool_radius(config.tool_radius_m) && config.tool_count >= 1 &&
      config.tool_count <= tool_capacity() && config.gravity_W.allFinite() &&
      is_finger_modulus(config.soft_finger_modulus_Pa) && is_sleep_time(config.sleep_after_s) &&
      valid(config.needle, objects) &&
      std::ranges::all_of(config.effects, [](const Effect& effect) { return valid(effect); });
  bool good = scene_.set(good_config ? objects : std::span<const Object>{}) && good_config;
  if (!bodies_.set(scene_, config.bodies, config.body_parts, laws_of(config))) {
    scene_.set({});
    good = false;
  }
  time_s_ = 0.0;
  tool_count_ = good ? config.tool_count : 1;
  effects_ = good ? config.effects : std::span<const Effect>{};
  for (std::size_t i = 0; i < tool_capacity(); ++i) {
    slot(i).touch.start(scene_, good ? config.tool_radius_m : 0.0,
                        good ? config.needle : NeedleScene{});
  }
  reset();
  return good;
}

void World::reset() {
  for (std::size_t i = 0; i < tool_capacity(); ++i) {
    reset(i);
  }
}

void World::reset(std::size_t tool) {
  slot(tool).touch.reset();
  slot(tool).effects.reset();
}

bool World::set_tick(double tick_s) {
  const bool good = std::isfinite(tick_s) && tick_s > 0.0;
  if (good) {
    tick_s_ = tick_s;
    set_tick_budget(default_tick_instructions(tick_s));
  }
  return good;
}

bool World::set_tick_budget(double instructions) {
  // More than any tick can take.
  constexpr double kNoLimit = 1e11;
  const bool good = instructions > 0.0;
  budget_ = good ? units_of(std::min(instructions, kNoLimit)) : budget_;
  return good;
}

double World::stretch_m(std::uint32_t object) const {
  double longest = 0.0;
  for (std::size_t i = 0; i < tool_count_; ++i) {
    longest = std::max(longest, slot(i).touch.stretch_m(scene_, object));
  }
  return longest;
}

bool World::is_touched(std::uint32_t object) const {
  return any_tool([&](const ToolTouch& tool) { return tool.touches(scene_, object); });
}

bool World::may_set_method(std::uint32_t object, ContactMethod method) const {
  if (is_tissue(scene_[object])) {
    return false;
  }
  const bool is_of_proxy = meets_proxy(scene_[object]) || meets_proxy(method);
  return !is_touched(object) &&
         (!is_of_proxy || !any_tool([](const ToolTouch& tool) { return !tool.has_free_proxy(); }));
}

bool World::set_method(std::uint32_t object, ContactMethod method) {
  if (object >= scene_.size() || !may_set_method(object, method)) {
    return false;
  }
  const bool met_proxy = meets_proxy(scene_[object]);
  if (!scene_.set_method(object, method)) {
    return false;
  }
  for (std::size_t i = 0; i < tool_count_; ++i) {
    slot(i).touch.take_method(scene_, object, met_proxy);
  }
  return true;
}

std::size_t World::begin_tick() {
  bodies_.place(scene_);
  standing_units_ =
      scene_.begin_tick(time_s_, tick_s_) + effect_units(effects_.size(), tool_count_);
  time_s_ += tick_s_;
  return budget_ - std::min(budget_, standing_units_);
}

template <class Watch>
Touch World::touch_one(std::size_t number, const ToolState& tool, std::size_t limit, Watch watch) {
  auto& [contacts, effects] = slot(number);
  Touch touch = contacts.touch(scene_, tool, limit, watch);
  if ((touch.flags & kTouchToolInvalid) != 0) {
    effects.hold();
  } else {
    effects.add_to(touch, effects_, tool, tick_s_);
  }
  return touch;
}

template <class Watch>
Touch World::touch_only(const ToolState& tool, Watch watch) {
  watch.see_step(TickStep::tool);
  const std::size_t limit = begin_tick();
  watch.see_step(TickStep::objects);
  Touch touch = touch_one(0, tool, limit, watch);
  watch.see_step(TickStep::force);
  step_bodies({&touch, 1});
  watch.see_step(TickStep::objects);
  return touch;
}

Touch World::touch(const ToolState& tool) {
  return touch_only(tool, Unwatched{});
}

Touch World::touch(const ToolState& tool, TickWatcher* watcher) {
  return watcher == nullptr ? touch(tool) : touch_only(tool, Watched{*watcher});
}

void World::step_bodies(std::span<Touch> touches) {
  if (!bodies_.any()) {
    return;
  }
  std::array<ToolGrips, kMaxTools> grips;
  for (std::size_t i = 0; i < tool_count_; ++i) {
    grips[i] = slot(i).touch.grips();
  }
  bodies_.step(scene_, std::span(grips).first(tool_count_));
  const std::uint32_t flags =
      bodies_.bodies().has_left_out_contacts() ? kTouchBodyContactsOverflow : kTouchClean;
  for (std::size_t i = 0; i < std::min(touches.size(), tool_count_); ++i) {
    touches[i].flags |= flags;
    if (grips[i].count > 0) {
      touches[i].force_W = grips[i].with_bodies(touches[i].force_W);
    }
  }
}

// Every tool may spend an equal share of what the tools before it have left.
void World::touch_all(std::span<const ToolState> tools, std::span<Touch> touches, const auto& watch,
                      const auto& touch_number) {
  // A tool that is not given is no number, which holds its proxies.
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  watch.see_step(TickStep::tool);
  std::size_t left = begin_tick();
  watch.see_step(TickStep::objects);
  for (std::size_t i = 0; i < tool_count_; ++i) {
    const ToolState tool = i < tools.size() ? tools[i] : ToolState{.p_W = Vec3::Constant(kNone)};
    const Touch touch = touch_number(i, tool, left / (tool_count_ - i));
    left -= std::min(left, slot(i).touch.spent());
    if (i < touches.size()) {
      touches[i] = touch;
    }
  }
  watch.see_step(TickStep::tool);
  step_bodies(touches);
  watch.see_step(TickStep::objects);
}

void World::touch(std::span<const ToolState> tools, std::span<Touch> touches) {
  touch_all(tools, touches, Unwatched{},
            [this](std::size_t i, const ToolState& tool, std::size_t limit) {
              return touch_one(i, tool, limit, Unwatched{});
            });
}

void World::touch(std::span<const ToolState> tools, std::span<Touch> touches,
                  std::span<TickWatcher* const> watchers) {
  if (std::ranges::all_of(watchers,
                          [](const TickWatcher* watcher) { return watcher == nullptr; })) {
    touch(tools, touches);
    return;
  }
  const ManyWatched all{watchers};
  touch_all(tools, touches, all, [&](std::size_t i, const ToolState& tool, std::size_t limit) {
    TickWatcher* const watcher = i < watchers.size() ? watchers[i] : nullptr;
    if (watcher == nullptr) {
      return touch_one(i, tool, limit, Unwatched{});
    }
    // The tools before it are no step of this one.
    watcher->see_step(TickStep::tool);
    const Touch touch = touch_one(i, tool, limit, Watched{*watcher});
    watcher->see_step(TickStep::force);
    return touch;
  });
}

std::size_t World::spent_units() const {
  std::size_t sum = standing_units_;
  for (std::size_t i = 0; i < tool_count_; ++i) {
    sum += slot(i).touch.spent();
  }
  return sum;
}

std::size_t World::peak_candidates() const {
  std::size_t peak = 0;
  for (std::size_t i = 0; i < tool_count_; ++i) {
    peak = std::max(peak, slot(i).touch.peak_candidates());
  }
  return peak;
}

}  // namespace tactus::rendering
