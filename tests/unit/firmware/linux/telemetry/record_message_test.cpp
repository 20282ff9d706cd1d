#include <gtest/gtest.h>

#include <random>

#include "firmware/linux/telemetry/record_encoder.h"
#include "firmware/telemetry/event_generated.h"
#include "firmware/telemetry/record_generated.h"
#include "host_tools/recording/record_decoder.h"
#include "tests/unit/firmware/linux/telemetry/random_tick.h"

namespace tactus::firmware {
namespace {

TEST(RecordMessage, CarriesEveryFieldOfATick) {
  const auto seed = std::random_device{}();
  RecordProperty("seed", std::to_string(seed));
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  RecordEncoder encoder;
  for (int i = 0; i < 1000; ++i) {
    const RecordedTick tick = random_tick(random);
    const auto decoded = host::decode_tick(encoder.encode(tick));
    ASSERT_TRUE(decoded.has_value());
    expect_equal(tick, *decoded);
  }
}

TEST(RecordMessage, LeavesRoomForWhatIsAddedLater) {
  std::mt19937_64 random(1);
  RecordEncoder encoder;
  EXPECT_LT(encoder.encode(random_tick(random)).size(), kMaxMessageBytes / 4);
}

TEST(RecordMessage, CarriesOnlyTheJointsThatTheDeviceHas) {
  RecordedTick tick;
  RecordEncoder encoder;
  const std::size_t without = encoder.encode(tick).size();
  tick.joint_count = 2;
  tick.record.joint_position = {1.0, 2.0, 0.0};
  const auto message = encoder.encode(tick);
  // A joint and its measured effort; the two vectors begin where doubles may.
  constexpr std::size_t kAJoint = sizeof(telemetry::Joint) + sizeof(double);
  EXPECT_GE(message.size(), without + 2 * kAJoint);
  EXPECT_LE(message.size(), without + 2 * kAJoint + 2 * alignof(double));
  const auto decoded = host::decode_tick(message);
  ASSERT_TRUE(decoded.has_value());
  expect_equal(tick, *decoded);
}

TEST(RecordMessage, CarriesAnEvent) {
  TelemetryEvent event{.tick = 17, .time_ns = -5, .kind = EventKind::parameter, .value = -0.25};
  set_name(event, "friction.static");
  RecordEncoder encoder;
  const auto decoded = host::decode_event(encoder.encode(event));
  ASSERT_TRUE(decoded.has_value());
  EXPECT_EQ(decoded->tick, 17U);
  EXPECT_EQ(decoded->time_ns, -5);
  EXPECT_EQ(decoded->kind, EventKind::parameter);
  EXPECT_EQ(name_of(*decoded), "friction.static");
  EXPECT_EQ(decoded->value, -0.25);
}

// Fills an explanation with numbers of which no two are equal.
Explanation some_explanation() {
  Explanation explanation{.tick = 17,
                          .time_ns = -5,
                          .feature = {.object = 2,
                                      .kind = rendering::ContactKind::edge,
                                      .face = 3,
                                      .edge = 1,
                                      .vertex = 4},
                          .is_feature_known = true,
                          .friction = rendering::FrictionState::slip,
                          .moves = 6,
                          .iterations = 7,
                          .tool_W = {0.01, 0.02, 0.03},
                          .proxy_W = {0.04, 0.05, 0.06},
                          .surface_W = {0.07, 0.08, 0.09},
                          .normal_W = {0.6, 0.0, 0.8},
                          .depth_m = 0.001,
                          .plane_count = 2,
                          .has_circle = true,
                          .circle = {.static_radius_m = 0.6, .dynamic_radius_m = 0.4, .lag_m = 0.5},
                          .step_ns = {10, 20, 30, 40, 50, 60, 70}};
  explanation.planes[0] = {
      .feature = {.object = 8, .kind = rendering::ContactKind::face, .face = 9},
      .normal_W = {1.0, 0.0, -0.0},
      .tool_distance_m = -0.002,
      .multiplier_m = 0.003};
  explanation.planes[1] = {
      .feature = {.object = 11, .kind = rendering::ContactKind::vertex, .face = 12, .vertex = 13},
      .normal_W = {0.0, 1.0, 0.0},
      .tool_distance_m = -0.004,
      .multiplier_m = 0.005};
  return explanation;
}

TEST(RecordMessage, CarriesAnExplanation) {
  const Explanation sent = some_explanation();
  RecordEncoder encoder;
  const auto read = host::decode_explanation(encoder.encode(sent));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(*read, sent);
}

TEST(RecordMessage, OfAnExplanationMayLackCirclesAndPlanes) {
  RecordEncoder encoder;
  const Explanation sent{.tick = 3};
  EXPECT_EQ(host::decode_explanation(encoder.encode(sent)), sent);
}

TEST(RecordMessage, OfAnExplanationIsRefusedWhenItIsShortOrAnother) {
  RecordEncoder encoder;
  const auto message = encoder.encode(some_explanation());
  for (std::size_t size = 0; size < message.size(); ++size) {
    EXPECT_FALSE(host::decode_explanation(message.first(size)).has_value()) << size;
  }
  EXPECT_FALSE(host::decode_tick(message).has_value());
  EXPECT_FALSE(host::decode_event(message).has_value());
}

// Fills places with numbers of which no two are equal.
ObjectPlaces some_places() {
  ObjectPlaces places{
      .tick = 17, .time_ns = -18, .count = static_cast<std::uint32_t>(rendering::kMaxMovers)};
  double number = 0.5;
  for (ObjectPlace& place : places.places) {
    place.object = static_cast<std::uint32_t>(number);
    for (double& value : place.origin_W) {
      value = number += 1.0;
    }
    for (double& value : place.rotation_W) {
      value = number += 1.0;
    }
  }
  return places;
}

TEST(RecordMessage, CarriesThePlacesOfAsManyObjectsAsCanMove) {
  const ObjectPlaces sent = some_places();
  RecordEncoder encoder;
  const auto read = host::decode_object_places(encoder.encode(sent));
  ASSERT_TRUE(read.has_value());
  EXPECT_EQ(read->tick, 17U);
  EXPECT_EQ(read->time_ns, -18);
  EXPECT_EQ(read->count, sent.count);
  EXPECT_EQ(read->places, sent.places);
}

TEST(RecordMessage, OfPlacesIsRefusedWhenItIsShortOrAnother) {
  RecordEncoder encoder;
  const auto message = encoder.encode(some_places());
  for (std::size_t size = 0; size < message.size(); size += 7) {
    EXPECT_FALSE(host::decode_object_places(message.first(size)).has_value()) << size;
  }
  EXPECT_FALSE(host::decode_tick(message).has_value());
  EXPECT_FALSE(host::decode_explanation(message).has_value());
}

TEST(RecordMessage, CarriesRunInformationAndCutsWhatIsTooLong) {
  const std::string long_text(kMaxMessageBytes, 'x');
  const std::array<MetadataEntry, 3> entries{{{"rate_hz", "1000"}, {"", ""}, {"long", long_text}}};
  RecordEncoder encoder;
  const auto decoded = host::decode_run_info(encoder.encode(std::span(entries)));
  ASSERT_TRUE(decoded.has_value());
  const host::RunInfo expected{{"rate_hz", "1000"}, {"", ""}};
  EXPECT_EQ(*decoded, expected);
}

TEST(RecordMessage, IsNotTakenForAnother) {
  RecordEncoder encoder;
  const auto message = encoder.encode(TelemetryEvent{});
  EXPECT_FALSE(host::decode_tick(message).has_value());
  EXPECT_FALSE(host::decode_run_info(message).has_value());
}

TEST(RecordMessage, IsRefusedWhenItIsShort) {
  RecordEncoder encoder;
  const auto message = encoder.encode(RecordedTick{});
  for (std::size_t size = 0; size < message.size(); ++size) {
    EXPECT_FALSE(host::decode_tick(message.first(size)).has_value()) << size;
  }
}

TEST(RecordMessage, NumbersEnumerationsAsTheControllerDoes) {
  EXPECT_EQ(static_cast<int>(telemetry::Mode::MAX), static_cast<int>(Mode::fault));
  EXPECT_EQ(static_cast<int>(telemetry::Request::MAX), static_cast<int>(Request::estop));
  EXPECT_EQ(static_cast<int>(telemetry::ContactKind::MAX),
            static_cast<int>(rendering::ContactKind::vertex));
  EXPECT_EQ(static_cast<int>(telemetry::FrictionState::MAX),
            static_cast<int>(rendering::FrictionState::slip));
  for (std::size_t i = 0; i < kModeNames.size(); ++i) {
    EXPECT_EQ(telemetry::EnumNameMode(static_cast<telemetry::Mode>(i)), kModeNames[i]);
  }
  for (std::size_t i = 0; i < kRequestNames.size(); ++i) {
    EXPECT_EQ(telemetry::EnumNameRequest(static_cast<telemetry::Request>(i)), kRequestNames[i]);
  }
  for (std::size_t i = 0; i < kEnergySourceNames.size(); ++i) {
    EXPECT_EQ(telemetry::EnumNameEnergySource(static_cast<telemetry::EnergySource>(i)),
              kEnergySourceNames[i]);
  }
  for (std::size_t i = 0; i < kEventKindNames.size(); ++i) {
    EXPECT_EQ(telemetry::EnumNameEventKind(static_cast<telemetry::EventKind>(i)),
              kEventKindNames[i]);
  }
}

}  // namespace
}  // namespace tactus::firmware
