#include "host_tools/touch/touch_csv.h"

#include <fmt/format.h>

#include <iterator>
#include <string>
#include <string_view>

namespace tactus::host {
namespace {

constexpr std::string_view kTouchColumns =
    "t_s,tool_x_m,tool_y_m,tool_z_m,proxy_x_m,proxy_y_m,proxy_z_m,force_x_N,force_y_N,force_z_N,"
    "contact,depth_m,friction_state,normal_x,normal_y,normal_z,object,flags,short_of_goal_m\n";

void append(std::string& line, const Vec3& v) {
  fmt::format_to(std::back_inserter(line), ",{},{},{}", v.x(), v.y(), v.z());
}

}  // namespace

TouchCsv::TouchCsv(const std::filesystem::path& path) : file_(path, kTouchColumns) {}

void TouchCsv::add(double t_s, const Vec3& tool_W, const rendering::Touch& touch) {
  std::string& line = file_.buffer();
  fmt::format_to(std::back_inserter(line), "{}", t_s);
  append(line, tool_W);
  append(line, touch.proxy_W);
  append(line, touch.force_W);
  fmt::format_to(std::back_inserter(line), ",{},{},{}", static_cast<int>(touch.contact),
                 touch.depth_m, static_cast<int>(touch.friction));
  append(line, touch.normal_W);
  if (touch.contact == rendering::ContactKind::none) {
    line += ',';
  } else {
    fmt::format_to(std::back_inserter(line), ",{}", touch.object);
  }
  fmt::format_to(std::back_inserter(line), ",{},{}\n", touch.flags, touch.short_of_goal_m);
  file_.flush_if_full();
}

}  // namespace tactus::host
