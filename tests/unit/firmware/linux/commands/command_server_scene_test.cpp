// Scenes and their parameters through the command socket.
#include <gtest/gtest.h>

#include <fstream>
#include <string>

#include "host_tools/remote/remote.h"
#include "host_tools/remote/reply_fields.h"
#include "rendering/limits.h"
#include "tests/unit/firmware/linux/commands/command_server_rig.h"
#include "tests/unit/rendering/scene/small_scene.h"

namespace tactus::firmware {
namespace {

using host::Remote;
using host::Reply;

TEST_F(CommandServerTest, AnObjectsParameterIsSetByName) {
  start();
  EXPECT_TRUE(begins(say("set object.right.stiffness_N_per_m 250"), "ok set tick="));
  const std::string read = say("get object.1.stiffness_N_per_m");
  EXPECT_EQ(host::field_of(read, "object.1.stiffness_N_per_m"), "250");
  EXPECT_EQ(say("set object.middle.stiffness_N_per_m 1"),
            "refused set: the scene has no such object; send list");
  EXPECT_EQ(say("set max_force_N nan"), "refused set: the value is not a finite number");
  EXPECT_EQ(say("set max_force_N 11"), "refused set: the value is out of its range, 0 to 10");
}

// Two potential fields in one place, whose forces add up.
host::BakedScene fields_in_one_place(double left_N_per_m, double right_N_per_m) {
  host::BakedScene scene = testing::small_scene();
  for (host::BakedObject& object : scene.objects) {
    object.contact = rendering::ContactMethod::potential_field;
    object.material = {};
  }
  scene.objects[0].material.stiffness_N_per_m = left_N_per_m;
  scene.objects[1].material.stiffness_N_per_m = right_N_per_m;
  return scene;
}

TEST_F(CommandServerTest, ARefusalByTheCertificateNamesWhatAddsUp) {
  ControllerConfig config = cartesian_config();
  config.certificate.count = 2;
  config.certificate.points[0] = {.stiffness_N_per_m = 1000.0};
  config.certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  ASSERT_TRUE(controller_->configure(config));
  start();
  write_scene("fields.tactus", fields_in_one_place(500.0, 300.0));
  write_scene("stiff.tactus", fields_in_one_place(500.0, 501.0));
  ASSERT_TRUE(begins(say("scene " + (folder_ / "fields.tactus").string()), "ok scene"));
  const std::string words =
      " are felt in one place and together have a stiffness of 1001 N/m, and the device is "
      "certified up to 1000 N/m with a damping of 0 N s/m; soften one of them or move them apart, "
      "certify a stiffer device with tactus certify, or take the risk with --allow-uncertified";
  EXPECT_EQ(say("set object.right.stiffness_N_per_m 501"),
            "refused set: object 'right' and object 'left'" + words);
  EXPECT_EQ(say("scene " + (folder_ / "stiff.tactus").string()),
            "refused scene: object 'left' and object 'right'" + words);
}

TEST_F(CommandServerTest, ARefusalAtAWallOfTheWorkspaceNamesItAndTheRemedy) {
  ControllerConfig config = cartesian_config();
  config.certificate.count = 2;
  config.certificate.points[0] = {.stiffness_N_per_m = 1000.0};
  config.certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  config.safety.workspace_lower_W = Vec3::Constant(-0.01);
  config.safety.workspace_upper_W = Vec3::Constant(0.01);
  config.safety.workspace_overrun_m = 1.0;
  ASSERT_TRUE(controller_->load_scene({}, {}));
  ASSERT_TRUE(controller_->configure(config));
  start();
  write_scene("soft.tactus", fields_in_one_place(499.0, 0.0));
  write_scene("stiff.tactus", fields_in_one_place(600.0, 0.0));
  ASSERT_TRUE(begins(say("scene " + (folder_ / "soft.tactus").string()), "ok scene"));
  EXPECT_EQ(say("scene " + (folder_ / "stiff.tactus").string()),
            "refused scene: object 'left' and the workspace's upper wall across x are felt in one "
            "place and together have a stiffness of 1100 N/m, and the device is certified up to "
            "1000 N/m with a damping of 1 N s/m; soften what is not a wall of the workspace or "
            "move it away from there, lower workspace_stiffness_N_per_m, certify a stiffer device "
            "with tactus certify, or take the risk with --allow-uncertified");
}

TEST_F(CommandServerTest, TheListHasEveryParameterWithItsRangeAndUnit) {
  start();
  const Reply list = Remote(folder_).send("list");
  EXPECT_EQ(list.text, "ok list");
  ASSERT_EQ(list.lines.size(), 5U + 2U * 6U);  // a cone has no viscous friction
  EXPECT_EQ(list.lines[0], "parameter max_force_N=10 least=0 greatest=10 unit=N");
  EXPECT_EQ(list.lines[5],
            "parameter object.0.stiffness_N_per_m=800 least=0 greatest=1e+06 unit=N/m object=left");
}

TEST_F(CommandServerTest, AnotherSceneIsTakenBetweenTwoTicks) {
  start();
  host::BakedScene scene = testing::small_scene();
  scene.objects.resize(1);
  scene.objects[0].name = "alone";
  write_scene("alone.tactus", scene);
  const std::string reply = say("scene " + (folder_ / "alone.tactus").string());
  EXPECT_TRUE(begins(reply, "ok scene tick=")) << reply;
  EXPECT_EQ(host::field_of(reply, "objects"), "1");
  EXPECT_TRUE(begins(say("get object.alone.damping_Ns_per_m"), "ok get"));
  EXPECT_TRUE(begins(say("get object.right.damping_Ns_per_m"), "refused"));
}

TEST_F(CommandServerTest, ASceneThatIsNoneLeavesTheOneInUse) {
  start();
  std::ofstream(folder_ / "bad.tactus") << "this is no image of a scene, as anybody can see";
  const std::string bad = say("scene " + (folder_ / "bad.tactus").string());
  EXPECT_TRUE(begins(bad, "refused scene: ")) << bad;
  const std::string missing = say("scene /no/such/file");
  EXPECT_EQ(missing, "refused scene: /no/such/file: cannot be read: No such file or directory");
  EXPECT_TRUE(begins(say("get object.right.damping_Ns_per_m"), "ok get"));
}

TEST_F(CommandServerTest, ASceneThatExceedsACapacityIsToldWhichByHowMuch) {
  start();
  host::BakedScene scene = testing::small_scene();
  scene.effects.assign(rendering::kMaxEffects + 1,
                       {.law = rendering::Spring{.stiffness_N_per_m = 1.0}, .max_force_N = 1.0});
  write_scene("full.tactus", scene);
  const std::string path = (folder_ / "full.tactus").string();
  const std::string reply = say("scene " + path);
  EXPECT_TRUE(begins(reply, "refused scene: " + path + ": " +
                                std::to_string(rendering::kMaxEffects + 1) + " effects, where " +
                                std::to_string(rendering::kMaxEffects) + " fit (profile " +
                                std::string(rendering::kProfile.name) + "); leave some out, or "))
      << reply;
}

TEST_F(CommandServerTest, NoSceneIsTakenWhileActive) {
  start();
  Remote remote(folder_);
  remote.send("home");
  while (!remote.send("enable").is_ok) {
  }
  EXPECT_EQ(remote.send("scene " + (folder_ / "left.tactus").string()).text,
            "refused scene: the mode is active; send disable first");
}

}  // namespace
}  // namespace tactus::firmware
