#include "firmware/linux/commands/command_line.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace tactus::firmware {
namespace {

std::string refusal_of(std::string_view line) {
  const auto command = parse_command(line);
  return command ? "taken" : std::string(command.error());
}

TEST(CommandLine, EveryRequestIsACommandByItsName) {
  for (const Request request :
       {Request::home, Request::enable, Request::disable, Request::reset, Request::estop}) {
    const auto command = parse_command(kRequestNames[static_cast<std::size_t>(request)]);
    ASSERT_TRUE(command);
    EXPECT_EQ(command->verb, Verb::request);
    EXPECT_EQ(command->request, request);
  }
}

TEST(CommandLine, NoneIsNoCommand) {
  EXPECT_EQ(refusal_of("none"), "there is no such command; send help");
  EXPECT_EQ(refusal_of("launch"), "there is no such command; send help");
}

TEST(CommandLine, ARequestTakesNoWords) {
  EXPECT_EQ(refusal_of("estop now"), "it takes no words");
}

TEST(CommandLine, GapsAndACarriageReturnDoNotMatter) {
  const auto command = parse_command("  set \t max_force_N   2.5 \r");
  ASSERT_TRUE(command);
  EXPECT_EQ(command->verb, Verb::set);
  EXPECT_EQ(command->name.parameter, Parameter::max_force);
  EXPECT_EQ(command->value, 2.5);
}

TEST(CommandLine, AnObjectsParameterIsNamedWithItsObject) {
  const auto command = parse_command("get object.left.wall.stiffness_N_per_m");
  ASSERT_TRUE(command);
  EXPECT_EQ(command->name.parameter, Parameter::stiffness);
  EXPECT_EQ(command->name.object, "left.wall");
}

TEST(CommandLine, AnObjectsParameterWithoutAnObjectIsRefusedAndTheOtherWayRound) {
  EXPECT_NE(refusal_of("get stiffness_N_per_m"), "taken");
  EXPECT_NE(refusal_of("get object.3.max_force_N"), "taken");
  EXPECT_NE(refusal_of("get object.stiffness_N_per_m"), "taken");
  EXPECT_NE(refusal_of("get object..stiffness_N_per_m"), "taken");
}

TEST(CommandLine, AValueIsOneNumberAndNothingElse) {
  EXPECT_NE(refusal_of("set max_force_N"), "taken");
  EXPECT_NE(refusal_of("set max_force_N 2,5"), "taken");
  EXPECT_NE(refusal_of("set max_force_N 2 5"), "taken");
  EXPECT_NE(refusal_of("set max_force_N 2N"), "taken");
}

TEST(CommandLine, NotANumberIsForTheControllerToRefuse) {
  const auto command = parse_command("set max_force_N nan");
  ASSERT_TRUE(command);
  EXPECT_TRUE(std::isnan(command->value));
}

TEST(CommandLine, AFileMayHaveSpaces) {
  EXPECT_EQ(parse_command("scene /my scenes/a b.tactus ")->file, "/my scenes/a b.tactus");
  EXPECT_EQ(parse_command("record on a b.mcap")->file, "a b.mcap");
  EXPECT_TRUE(parse_command("record off")->file.empty());
  EXPECT_NE(refusal_of("record on"), "taken");
  EXPECT_NE(refusal_of("record"), "taken");
  EXPECT_NE(refusal_of("scene"), "taken");
}

TEST(CommandLine, EveryInjectionIsNamedInTheRefusalOfAnUnknownOne) {
  const std::string refusal = refusal_of("inject fire");
  for (const InjectionText& text : kInjectionTexts) {
    EXPECT_NE(refusal.find(text.name), std::string::npos) << text.name;
    const auto command = parse_command("inject " + std::string(text.name) + " 3");
    ASSERT_TRUE(command) << text.name;
    EXPECT_EQ(command->injection.injection, text.injection);
    EXPECT_EQ(command->injection.ticks, 3U);
  }
}

TEST(CommandLine, InjectionsEndAndDelaysEndSoon) {
  EXPECT_NE(refusal_of("inject drop 0"), "taken");
  EXPECT_NE(refusal_of("inject drop -1"), "taken");
  EXPECT_NE(refusal_of("inject drop 100001"), "taken");
  EXPECT_NE(refusal_of("inject delay 101"), "taken");
  EXPECT_EQ(parse_command("inject stuck")->injection.ticks, 1U);
}

TEST(CommandLine, AFrictionModelAndAContactMethodAreSetByTheirNames) {
  const auto contact = parse_command("set object.ball.contact one_plane");
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->name.parameter, Parameter::contact);
  EXPECT_EQ(contact->name.object, "ball");
  EXPECT_EQ(contact->value, 5.0);
  EXPECT_EQ(parse_command("set object.0.friction_model lugre")->value, 5.0);
  // The tick knows what the object allows, and refuses every other word.
  EXPECT_EQ(parse_command("set object.0.contact two_planes")->value, -1.0);
  EXPECT_EQ(parse_command("set object.0.contact 5")->value, -1.0);
  EXPECT_NE(refusal_of("set object.0.contact"), "taken");
  EXPECT_NE(refusal_of("set object.0.contact one_plane now"), "taken");
}

}  // namespace
}  // namespace tactus::firmware
