#include "host_tools/remote/reply_fields.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace tactus::host {
namespace {

using Json = nlohmann::json;

Json parsed(const Reply& reply) {
  return Json::parse(json_of(reply).dump());
}

// The replies are those of firmware/linux/commands/README.md.
TEST(ReplyFields, AStatusHasItsFieldsWithNumbersAsNumbers) {
  EXPECT_EQ(parsed({.is_ok = true,
                    .text = "ok status tick=99 mode=ready faults=none scene=/home/ada/a b.tactus"}),
            (Json{{"ok", true},
                  {"command", "status"},
                  {"tick", 99},
                  {"mode", "ready"},
                  {"faults", Json::array()},
                  {"scene", "/home/ada/a b.tactus"}}));
  const Json fault = parsed(
      {.is_ok = true, .text = "ok status tick=7 mode=fault faults=drive,encoder scene=none"});
  EXPECT_EQ(fault["faults"], (Json{"drive", "encoder"}));
}

TEST(ReplyFields, AValueInQuotationMarksHasBlanks) {
  const Json home = parsed(
      {.is_ok = true, .text = "ok home tick=12 mode=homing hint=\"hold 'left' still at 180 deg\""});
  EXPECT_EQ(home["hint"], "hold 'left' still at 180 deg");
  EXPECT_EQ(home["tick"], 12);
}

TEST(ReplyFields, AParameterHasItsNameBesideItsValue) {
  EXPECT_EQ(
      parsed({.is_ok = true, .text = "ok get tick=40 max_force_N=8.5 least=0 greatest=8 unit=N"}),
      (Json{{"ok", true},
            {"command", "get"},
            {"tick", 40},
            {"name", "max_force_N"},
            {"value", 8.5},
            {"least", 0},
            {"greatest", 8},
            {"unit", "N"}}));
  const Json contact =
      parsed({.is_ok = true,
              .text = "ok get tick=40 object.0.contact=one_plane choices=sphere_proxy,god_object"});
  EXPECT_EQ(contact["value"], "one_plane");
  EXPECT_EQ(contact["choices"], (Json{"sphere_proxy", "god_object"}));
}

TEST(ReplyFields, AListHasAllParameters) {
  const Json list = parsed({.is_ok = true,
                            .text = "ok list",
                            .lines = {"parameter max_force_N=8 least=0 greatest=8 unit=N",
                                      "parameter object.0.stiffness_N_per_m=800 least=0 "
                                      "greatest=1e+06 unit=N/m object=my ball"}});
  ASSERT_EQ(list["parameters"].size(), 2U);
  EXPECT_EQ(list["parameters"][0]["name"], "max_force_N");
  EXPECT_EQ(list["parameters"][1]["greatest"], 1e6);
  EXPECT_EQ(list["parameters"][1]["object"], "my ball");
}

TEST(ReplyFields, ARefusalKeepsItsWords) {
  EXPECT_EQ(parsed({.is_ok = false,
                    .text = "refused reset tick=77 mode=fault: the mode is fault (drive); remove "
                            "the cause, then send reset again"}),
            (Json{{"ok", false},
                  {"command", "reset"},
                  {"text",
                   "refused reset tick=77 mode=fault: the mode is fault (drive); remove the cause, "
                   "then send reset again"}}));
}

TEST(ReplyFields, HostileTextStaysText) {
  for (const std::string text : {"", "ok", "ok ", "ok x =", "ok x a=\"", "ok x a= b==c",
                                 "ok x 1=0x10 2=1e999 3=nan 4=01 5=-", "ok x \xff\xfe=\xff"}) {
    const std::string dumped =
        json_of({.is_ok = true, .text = text})
            .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    EXPECT_TRUE(Json::accept(dumped)) << text;
  }
}

TEST(ReplyFields, ATableHasALineForEachParameterWithAlignedColumns) {
  EXPECT_EQ(
      parameter_table(
          {"parameter max_force_N=8 least=0 greatest=10 unit=N",
           "parameter object.0.static_friction=0.5 least=0 greatest=10 unit=1 object=cup",
           "parameter object.0.contact=god_object choices=sphere_proxy,god_object object=cup"}),
      "parameter                      value  unit  range\n"
      "max_force_N                        8  N     0 to 10\n"
      "object.0.static_friction         0.5        0 to 10   (cup)\n"
      "object.0.contact          god_object        sphere_proxy, god_object   (cup)\n");
}

}  // namespace
}  // namespace tactus::host
