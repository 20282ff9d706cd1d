// The parameters with names for values: what is refused, and what the certificate says to them.
#include "firmware/control/parameter_choices.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "firmware/control/controller.h"
#include "rendering/friction/friction_model.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

using rendering::ContactMethod;
using rendering::FrictionKind;

constexpr ParameterPlace kSetContact{.parameter = Parameter::contact, .object = 0};
constexpr ParameterPlace kSetModel{.parameter = Parameter::friction_model, .object = 0};

constexpr double number_of(ContactMethod method) {
  return static_cast<double>(method);
}
constexpr double number_of(FrictionKind kind) {
  return static_cast<double>(kind);
}

drivers::JointSample above_floor(double y) {
  drivers::JointSample sample;
  sample.position = {0.01, y, 0.02};
  return sample;
}

ParameterRefusal refusal_of(Controller& controller, const ParameterPlace& place, double value) {
  const auto done = controller.set_parameter({.place = place, .value = value});
  EXPECT_FALSE(done);
  return done ? ParameterRefusal{} : done.error();
}

// A Cartesian device over a floor at y = 0.
class ParameterChoicesTest : public ::testing::Test {
 protected:
  ParameterChoicesTest() {
    EXPECT_TRUE(controller_.configure(testing::without_sign_check(cartesian_config())));
    EXPECT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  }

  void start() {
    controller_.tick(above_floor(0.05), Request::home);
    controller_.tick(above_floor(0.05), Request::none);
    controller_.tick(above_floor(0.05), Request::enable);
  }
  void press() {
    for (int tick = 0; tick < 600; ++tick) {
      controller_.tick(above_floor(-0.004), Request::none);
    }
    ASSERT_EQ(controller_.mode(), Mode::active);
    ASSERT_NE(controller_.record().contact, rendering::ContactKind::none);
  }

  Floor floor_{{.stiffness_N_per_m = 500.0,
                .damping_Ns_per_m = 0.0,
                .friction = rendering::cone_friction(0.6, 0.4)}};
  Controller controller_;
};

TEST_F(ParameterChoicesTest, AChangeIsRecordedByTheTickThatHasIt) {
  start();
  const auto event = controller_.set_parameter(
      {.place = kSetContact, .value = number_of(ContactMethod::one_plane)});
  ASSERT_TRUE(event);
  controller_.tick(above_floor(0.05), Request::none);
  EXPECT_EQ(controller_.record().tick, event->tick);
  EXPECT_EQ(controller_.record().change.place, kSetContact);
  EXPECT_EQ(controller_.record().change.value, 5.0);
  EXPECT_EQ(controller_.parameter(kSetContact)->value, 5.0);
}

TEST_F(ParameterChoicesTest, AreRefusedUnderAPressedToolAndTheForceStays) {
  start();
  press();
  const double force_N = controller_.record().force_commanded_W[1];
  EXPECT_EQ(refusal_of(controller_, kSetContact, number_of(ContactMethod::god_object)),
            ParameterRefusal::touched);
  EXPECT_EQ(refusal_of(controller_, kSetModel, number_of(FrictionKind::lugre)),
            ParameterRefusal::touched);
  controller_.tick(above_floor(-0.004), Request::none);
  EXPECT_EQ(controller_.record().force_commanded_W[1], force_N);
  EXPECT_NE(describe(ParameterRefusal::touched).find("lift the tool and set it again"),
            std::string_view::npos);
  // The value that it has is no change.
  EXPECT_TRUE(controller_.set_parameter(
      {.place = kSetContact, .value = number_of(ContactMethod::sphere_proxy)}));
  controller_.tick(above_floor(0.01), Request::none);
  EXPECT_TRUE(controller_.set_parameter(
      {.place = kSetContact, .value = number_of(ContactMethod::god_object)}));
}

TEST_F(ParameterChoicesTest, AreRefusedWhileTheToolIsInAnObjectInWhichItBegan) {
  const std::array ball{rendering::Object{
      .surface = rendering::SurfaceKind::primitive,
      .primitive = {.kind = rendering::PrimitiveKind::sphere, .dimensions_m = {0.03, 0.0, 0.0}},
      .material = {.stiffness_N_per_m = 500.0}}};
  for (const ContactMethod method : {ContactMethod::potential_field, ContactMethod::sphere_proxy}) {
    std::array objects = ball;
    objects[0].method = method;
    Controller controller;
    ASSERT_TRUE(controller.configure(cartesian_config()));
    ASSERT_TRUE(controller.load_scene(objects, {.tool_radius_m = 0.005}));
    for (const Request request : {Request::home, Request::none, Request::enable}) {
      controller.tick(above_floor(0.025), request);
    }
    ASSERT_EQ(controller.record().contact, rendering::ContactKind::none);
    EXPECT_EQ(refusal_of(controller, kSetContact, number_of(ContactMethod::god_object)),
              ParameterRefusal::touched);
    controller.tick(above_floor(0.05), Request::none);
    controller.tick(above_floor(0.05), Request::none);
    EXPECT_TRUE(controller.set_parameter(
        {.place = kSetContact, .value = number_of(ContactMethod::god_object)}));
  }
}

TEST_F(ParameterChoicesTest, AValueWithoutANameIsNone) {
  for (const double value : {kNoChoice, 0.5, 10.0, 1e9}) {
    EXPECT_EQ(refusal_of(controller_, kSetContact, value), ParameterRefusal::not_a_choice) << value;
    EXPECT_EQ(refusal_of(controller_, kSetModel, value), ParameterRefusal::not_a_choice) << value;
  }
  // The floor has no neighbours, which a feature walk and a potential field need.
  for (const ContactMethod method :
       {ContactMethod::tracking, ContactMethod::feature_walk, ContactMethod::potential_field}) {
    EXPECT_EQ(refusal_of(controller_, kSetContact, number_of(method)),
              ParameterRefusal::not_a_choice);
  }
}

TEST_F(ParameterChoicesTest, ATextbooksMethodHasTheConeOnly) {
  ASSERT_TRUE(
      controller_.set_parameter({.place = kSetModel, .value = number_of(FrictionKind::dahl)}));
  EXPECT_EQ(refusal_of(controller_, kSetContact, number_of(ContactMethod::one_plane)),
            ParameterRefusal::not_a_choice);
  ASSERT_TRUE(
      controller_.set_parameter({.place = kSetModel, .value = number_of(FrictionKind::cone)}));
  ASSERT_TRUE(controller_.set_parameter(
      {.place = kSetContact, .value = number_of(ContactMethod::one_plane)}));
  EXPECT_EQ(refusal_of(controller_, kSetModel, number_of(FrictionKind::dahl)),
            ParameterRefusal::not_a_choice);
}

TEST_F(ParameterChoicesTest, AModelHasItsOwnTermsAndTheStaticLevelComesBack) {
  const ParameterPlace at_rest{.parameter = Parameter::static_friction, .object = 0};
  const ParameterPlace viscous{.parameter = Parameter::viscous_friction, .object = 0};
  ASSERT_TRUE(
      controller_.set_parameter({.place = kSetModel, .value = number_of(FrictionKind::dahl)}));
  EXPECT_EQ(controller_.parameter(at_rest).error(), ParameterRefusal::not_of_this_model);
  EXPECT_TRUE(controller_.set_parameter({.place = viscous, .value = 0.1}));
  ASSERT_TRUE(
      controller_.set_parameter({.place = kSetModel, .value = number_of(FrictionKind::lugre)}));
  EXPECT_EQ(controller_.parameter(at_rest)->value, 0.6);
  EXPECT_EQ(controller_.parameter(viscous)->value, 0.1);
}

TEST_F(ParameterChoicesTest, ANewSceneAndOnlyThatHasItsOwn) {
  ASSERT_TRUE(
      controller_.set_parameter({.place = kSetModel, .value = number_of(FrictionKind::dahl)}));
  ASSERT_TRUE(controller_.set_parameter(
      {.place = kSetContact, .value = number_of(ContactMethod::god_object)}));
  ASSERT_TRUE(controller_.configure(testing::without_sign_check(cartesian_config())));
  EXPECT_EQ(controller_.parameter(kSetModel)->value, number_of(FrictionKind::dahl));
  EXPECT_EQ(controller_.parameter(kSetContact)->value, number_of(ContactMethod::god_object));
  ASSERT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  EXPECT_EQ(controller_.parameter(kSetModel)->value, number_of(FrictionKind::cone));
  EXPECT_EQ(controller_.parameter(kSetContact)->value, number_of(ContactMethod::sphere_proxy));
}

rendering::Object cube_at(double x_m) {
  return {.surface = rendering::SurfaceKind::primitive,
          .primitive = {.kind = rendering::PrimitiveKind::box,
                        .X_WO = {Mat3::Identity(), {x_m, 0.0, 0.0}},
                        .dimensions_m = {0.02, 0.02, 0.02}},
          .material = {.stiffness_N_per_m = 600.0, .friction = rendering::cone_friction(0.6, 0.4)}};
}

// Two boxes of 600 N/m that overlap: the shared proxy's spring is a mean of theirs, but a field
// adds to it.
TEST(ParameterChoices, AMethodThatMakesObjectsPushTogetherIsHeldAgainstTheCertificate) {
  std::array objects{cube_at(0.0), cube_at(0.005)};
  objects[1].primitive.X_WO.translation.y() = 0.004;
  objects[1].primitive.X_WO.translation.z() = 0.003;
  ControllerConfig config = testing::without_sign_check(cartesian_config());
  config.certificate.count = 2;
  config.certificate.points[0] = {.damping_Ns_per_m = 0.0, .stiffness_N_per_m = 1000.0};
  config.certificate.points[1] = {.damping_Ns_per_m = 4.0, .stiffness_N_per_m = 1000.0};
  const ParameterChange change{.place = kSetContact,
                               .value = number_of(ContactMethod::potential_field)};
  Controller controller;
  ASSERT_TRUE(controller.configure(config));
  ASSERT_TRUE(controller.load_scene(objects, {.tool_radius_m = 0.002}));
  EXPECT_EQ(refusal_of(controller, kSetContact, change.value), ParameterRefusal::uncertified);
  EXPECT_GT(controller.uncertified_part().stiffness_N_per_m, 1000.0);
  EXPECT_EQ(controller.parameter(kSetContact)->value, number_of(ContactMethod::sphere_proxy));
  // A scene that is baked so is refused as well.
  std::array baked = objects;
  baked[0].method = ContactMethod::potential_field;
  EXPECT_FALSE(controller.load_scene(baked, {.tool_radius_m = 0.002}));
  config.allow_uncertified = true;
  ASSERT_TRUE(controller.configure(config));
  EXPECT_TRUE(controller.set_parameter(change));
}

TEST(ParameterChoices, OnlySoManyObjectsHaveAContactOfTheirOwn) {
  const Floor floor({.stiffness_N_per_m = 10.0, .damping_Ns_per_m = 0.0, .friction = {}});
  std::vector<rendering::Object> objects(rendering::kMaxIndependentObjects + 1, floor.objects()[0]);
  for (std::size_t i = 1; i < objects.size(); ++i) {
    objects[i].method = ContactMethod::one_plane;
  }
  Controller controller;
  ASSERT_TRUE(controller.configure(cartesian_config()));
  ASSERT_TRUE(controller.load_scene(objects, {.tool_radius_m = 0.0}));
  const ParameterPlace last{.parameter = Parameter::contact,
                            .object = rendering::kMaxIndependentObjects};
  EXPECT_EQ(refusal_of(controller, kSetContact, number_of(ContactMethod::one_plane)),
            ParameterRefusal::too_many_contacts);
  ASSERT_TRUE(
      controller.set_parameter({.place = last, .value = number_of(ContactMethod::sphere_proxy)}));
  EXPECT_TRUE(controller.set_parameter(
      {.place = kSetContact, .value = number_of(ContactMethod::one_plane)}));
}

TEST(ParameterChoices, EveryNameIsThatOfItsNumber) {
  for (const Parameter parameter : {Parameter::friction_model, Parameter::contact}) {
    ASSERT_TRUE(has_choices(parameter));
    for (std::uint32_t i = 0; i < choice_count(parameter); ++i) {
      EXPECT_EQ(choice_of(parameter, choice_name(parameter, i)), i);
    }
    EXPECT_EQ(choice_name(parameter, choice_count(parameter)), "");
    EXPECT_EQ(choice_of(parameter, ""), kNoChoice);
  }
  EXPECT_EQ(choice_count(Parameter::stiffness), 0U);
  EXPECT_EQ(choice_name(Parameter::contact, 5.0), "one_plane");
  EXPECT_EQ(choice_name(Parameter::friction_model, 4.0), "dahl");
}

}  // namespace
}  // namespace tactus::firmware
