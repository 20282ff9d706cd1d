#include "host_tools/monitor/explain_line.h"

#include <gtest/gtest.h>

#include "tests/unit/host_tools/monitor/example_run.h"

namespace tactus::host {
namespace {

TEST(ExplainLine, TellsTheStoryOfATickAtAnEdge) {
  EXPECT_EQ(explain_line(example_explanation()),
            "tick=100 state=edge friction=slip moves=6 iterations=0 "
            "tool_x_m=0.0101 tool_y_m=-0.0202 tool_z_m=0.0303 "
            "proxy_x_m=0.0101 proxy_y_m=-0.0202 proxy_z_m=0.031534 object=2 face=17 edge=1 "
            "surface_x_m=0.0101 surface_y_m=-0.0202 surface_z_m=0.029534 "
            "normal_x=0 normal_y=0 normal_z=1 depth_m=0.001234 planes=2 "
            "plane1_object=2 plane1_face=17 plane1_edge=1 "
            "plane1_normal_x=0.6 plane1_normal_y=0 plane1_normal_z=0.8 "
            "plane1_tool_distance_m=-0.0009 plane1_multiplier_m=0.0007 "
            "plane2_object=2 plane2_face=18 "
            "plane2_normal_x=-0.6 plane2_normal_y=0 plane2_normal_z=0.8 "
            "plane2_tool_distance_m=-0.0008 plane2_multiplier_m=0.0006 "
            "static_radius_m=0.00074 dynamic_radius_m=0.00049 lag_m=0.00082 "
            "read_ns=45200 tool_ns=900 collision_ns=800 proxy_ns=400 force_ns=200 command_ns=30300 "
            "objects_ns=100");
}

TEST(ExplainLine, LeavesOutWhatAFreeTickDoesNotHave) {
  EXPECT_EQ(explain_line({.tick = 3, .tool_W = {0.5, 0.0, 0.0}, .proxy_W = {0.5, 0.0, 0.0}}),
            "tick=3 state=free friction=free moves=0 iterations=0 tool_x_m=0.5 tool_y_m=0 "
            "tool_z_m=0 proxy_x_m=0.5 proxy_y_m=0 proxy_z_m=0 planes=0 read_ns=0 tool_ns=0 "
            "collision_ns=0 proxy_ns=0 force_ns=0 command_ns=0 objects_ns=0");
}

TEST(ExplainLine, BearsWhatANewerControllerMaySend) {
  firmware::Explanation explanation;
  explanation.feature.kind = static_cast<rendering::ContactKind>(9);
  explanation.friction = static_cast<rendering::FrictionState>(9);
  explanation.plane_count = 200;
  EXPECT_EQ(contact_state(explanation), "unknown");
  EXPECT_EQ(friction_word(explanation), "unknown");
  EXPECT_NE(explain_line(explanation).find("planes=3 "), std::string::npos);
}

}  // namespace
}  // namespace tactus::host
