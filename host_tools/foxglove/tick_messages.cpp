#include "host_tools/foxglove/tick_messages.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <sstream>
#include <string_view>

#include "host_tools/foxglove/json_parts.h"
#include "host_tools/recording/record_columns.h"

namespace tactus::host {
namespace {

// The topics of a device that have schemas of Foxglove, in the order of their channels.
enum DeviceChannel : std::size_t { kToolChannel, kProxyChannel, kMarkersChannel, kFixedChannels };

// A topic of columns. The fields are those of chosen_columns(), apart by blanks.
struct ColumnTopic {
  std::string_view name;
  std::string_view schema;
  std::string_view fields;
};
constexpr std::array<ColumnTopic, 4> kColumnTopics = {
    {{"/force", "tactus.Force", "force rendered normal depth tool_v"},
     {"/joints", "tactus.Joints",
      "joint velocity effort measured compensation gravity shaft torque"},
     {"/state", "tactus.State",
      "tick time mode request faults limits contact friction object sub_goals planes device_status "
      "fault_joint fault_device limited_source passivity energy faults_entered limited_ticks"},
     {"/timing", "tactus.Timing",
      "sample_age loop_status missed_ticks late_ticks stale_samples read check kinematics touch_ns "
      "safety write dropped"}}};

std::vector<std::string> words_in(std::string_view text) {
  std::istringstream stream{std::string(text)};
  return {std::istream_iterator<std::string>(stream), {}};
}

// The times of the loop that are differences of columns, under the names of the JSON over UDP.
constexpr std::string_view kWakeLatency = "wake_latency_ns";
constexpr std::string_view kBusy = "busy_ns";
constexpr std::string_view kTimingTopic = "/timing";

// The length of the arrow of a force.
constexpr double kArrow_m_per_N = 0.01;
// The radius by which a tool without one is drawn.
constexpr double kPointRadius_m = 0.001;

struct MarkerColour {
  double red = 0.0;
  double green = 0.0;
  double blue = 0.0;
  double opacity = 1.0;
};
constexpr MarkerColour kToolColour{.red = 0.84, .green = 0.37, .blue = 0.0, .opacity = 0.5};
constexpr MarkerColour kProxyColour{.red = 0.0, .green = 0.45, .blue = 0.70};
constexpr MarkerColour kForceColour{.red = 0.94, .green = 0.89, .blue = 0.26};

std::string colour_json(const MarkerColour& colour) {
  return fmt::format(R"({{"r":{},"g":{},"b":{},"a":{}}})", colour.red, colour.green, colour.blue,
                     colour.opacity);
}

std::string sphere_json(const firmware::Triple& center, double radius_m,
                        const MarkerColour& colour) {
  const double diameter_m = 2.0 * radius_m;
  return fmt::format(R"({{"pose":{},"size":{},"color":{}}})", pose_json(center, kUnturned),
                     vector_json({diameter_m, diameter_m, diameter_m}), colour_json(colour));
}

// Returns the arrow of a force that ends at the tool's hand; nothing without a force.
std::string arrow_json(const firmware::Triple& tool, const firmware::Triple& force_N,
                       double radius_m) {
  const Vec3 force(force_N[0], force_N[1], force_N[2]);
  const double length_m = kArrow_m_per_N * force.norm();
  if (!(length_m > 0.0) || !std::isfinite(length_m)) {
    return {};
  }
  const auto q = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), force);
  const double head_m = std::min(0.3 * length_m, 2.0 * radius_m);
  return fmt::format(
      R"({{"pose":{},"shaft_length":{:.9g},"shaft_diameter":{:.9g},"head_length":{:.9g},)"
      R"("head_diameter":{:.9g},"color":{}}})",
      pose_json(tool, {q.w(), q.x(), q.y(), q.z()}), length_m - head_m, 0.5 * radius_m, head_m,
      radius_m, colour_json(kForceColour));
}

std::string pose_message(const firmware::Triple& position, std::uint64_t time_ns) {
  return fmt::format(R"({{"timestamp":{},"frame_id":"{}","pose":{}}})", time_json(time_ns),
                     kWorldFrame, pose_json(position, kUnturned));
}

// Returns true if the text is a number that JSON has: not "inf" or "nan".
bool is_json_number(const TickWord& word) {
  return word.is_number && word.text.find_first_not_of("0123456789.+-e") == std::string::npos;
}

}  // namespace

DeviceTopics::DeviceTopics(const std::string& prefix, std::size_t joints)
    : joints_(joints), prefix_(prefix), names_(column_names(joints)) {
  channels_.push_back({prefix + "/tool", kPoseInFrameSchema, pose_in_frame_schema()});
  channels_.push_back({prefix + "/proxy", kPoseInFrameSchema, pose_in_frame_schema()});
  channels_.push_back({prefix + "/markers", kSceneUpdateSchema, scene_update_schema()});
  read_words(tick_, joints, words_);
  for (const ColumnTopic& topic : kColumnTopics) {
    const Columns& columns = columns_.emplace_back(chosen_columns(words_in(topic.fields), joints));
    std::vector<NamedField> named;
    named.reserve(columns.size() + 2);
    for (const std::size_t column : columns) {
      named.push_back({.name = names_[column], .is_number = words_[column].is_number});
    }
    if (topic.name == kTimingTopic) {
      named.push_back({.name = std::string(kWakeLatency)});
      named.push_back({.name = std::string(kBusy)});
    }
    channels_.push_back({prefix + std::string(topic.name), std::string(topic.schema),
                         fields_schema(std::string(topic.schema), named)});
  }
}

void DeviceTopics::take(const firmware::RecordedTick& tick, std::uint64_t time_ns,
                        double radius_m) {
  tick_ = tick;
  time_ns_ = time_ns;
  radius_m_ = radius_m > 0.0 ? radius_m : kPointRadius_m;
  read_words(tick_, joints_, words_);
}

std::string DeviceTopics::message(std::size_t channel) const {
  switch (channel) {
    case kToolChannel:
      return pose_message(tick_.record.tool_p_W, time_ns_);
    case kProxyChannel:
      return pose_message(tick_.record.proxy_W, time_ns_);
    case kMarkersChannel:
      return markers();
    default:
      return fields(columns_[channel - kFixedChannels]);
  }
}

std::string DeviceTopics::markers() const {
  const firmware::TelemetryRecord& record = tick_.record;
  return fmt::format(
      R"({{"deletions":[],"entities":[{{"timestamp":{},"frame_id":"{}","id":{},)"
      R"("lifetime":{{"sec":0,"nsec":0}},"frame_locked":true,"metadata":[],"arrows":[{}],)"
      R"("cubes":[],"spheres":[{},{}],"cylinders":[],"lines":[],"triangles":[],"texts":[],)"
      R"("models":[]}}]}})",
      time_json(time_ns_), kWorldFrame, text_json("tool" + prefix_),
      arrow_json(record.tool_p_W, record.force_commanded_W, radius_m_),
      sphere_json(record.tool_p_W, radius_m_, kToolColour),
      sphere_json(record.proxy_W, radius_m_, kProxyColour));
}

std::string DeviceTopics::fields(const Columns& columns) const {
  std::string text;
  const auto add = [&text](std::string_view name, std::string_view value) {
    text += fmt::format("{}{}:{}", text.empty() ? "{" : ",", text_json(name), value);
  };
  for (const std::size_t column : columns) {
    const TickWord& word = words_[column];
    if (is_json_number(word)) {
      add(names_[column], word.text);
    } else if (!word.is_number) {
      add(names_[column], text_json(word.text));
    }
  }
  if (&columns == &columns_.back()) {
    add(kWakeLatency, fmt::format("{}", tick_.loop.wake_latency_ns()));
    add(kBusy, fmt::format("{}", tick_.loop.busy_ns()));
  }
  return text.empty() ? "{}" : text + "}";
}

}  // namespace tactus::host
