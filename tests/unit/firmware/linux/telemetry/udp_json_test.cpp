#include "firmware/linux/telemetry/udp_json.h"

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <random>

#include "tests/unit/firmware/linux/telemetry/random_tick.h"

namespace tactus::firmware {
namespace {

nlohmann::json json_of(const RecordedTick& tick) {
  std::array<char, kMaxDatagramBytes> room;
  const auto text = write_json(tick, room);
  return nlohmann::json::parse(text.begin(), text.end());
}

TEST(UdpJson, SaysWhatTheTickDid) {
  RecordedTick tick;
  tick.joint_count = 2;
  tick.record.tick = 42;
  tick.record.time_s = 0.042;
  tick.record.mode = Mode::active;
  tick.record.tool_p_W = {0.01, -0.02, 0.03};
  tick.record.joint_position = {1.5, -2.5, 99.0};
  tick.loop = {.scheduled_ns = 1000, .woke_ns = 1700, .done_ns = 2900};
  const auto json = json_of(tick);
  EXPECT_EQ(json.at("tick"), 42);
  EXPECT_EQ(json.at("timestamp"), 0.042);
  EXPECT_EQ(json.at("mode"), static_cast<int>(Mode::active));
  EXPECT_EQ(json.at("tool_m").at("y"), -0.02);
  EXPECT_EQ(json.at("joint_position"), nlohmann::json::array({1.5, -2.5}));
  EXPECT_EQ(json.at("wake_latency_ns"), 700);
  EXPECT_EQ(json.at("busy_ns"), 1200);
}

TEST(UdpJson, IsAlwaysWholeAndNeverLongerThanADatagram) {
  const auto seed = std::random_device{}();
  SCOPED_TRACE(seed);
  std::mt19937_64 random(seed);
  for (int i = 0; i < 2000; ++i) {
    RecordedTick tick = random_tick(random);
    EXPECT_NO_THROW(json_of(tick));
  }
  RecordedTick longest = random_tick(random);
  visit_tick_fields(longest, [](const FieldName&, auto& field) {
    using Field = std::remove_reference_t<decltype(field)>;
    if constexpr (std::is_integral_v<Field>) {
      field = std::numeric_limits<Field>::max();
    } else if constexpr (std::is_floating_point_v<Field>) {
      field = -1.23456789e-308;
    } else if constexpr (!std::is_enum_v<Field>) {
      field.fill(-1.23456789e-308);
    }
  });
  longest.loop.woke_ns = std::numeric_limits<std::int64_t>::min() / 2;
  longest.loop.scheduled_ns = -longest.loop.woke_ns;
  longest.loop.done_ns = 0;
  EXPECT_NO_THROW(json_of(longest));
}

TEST(UdpJson, GivesNullForWhatIsNoNumber) {
  RecordedTick tick;
  tick.record.depth_m = std::numeric_limits<double>::quiet_NaN();
  tick.record.tool_p_W[1] = std::numeric_limits<double>::infinity();
  const auto json = json_of(tick);
  EXPECT_TRUE(json.at("depth_m").is_null());
  EXPECT_TRUE(json.at("tool_m").at("y").is_null());
}

TEST(UdpJson, ReachesAListenerAndMissesNoneWhoIsNotThere) {
  const hal::FileDescriptor listener(socket(AF_INET, SOCK_DGRAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  ASSERT_EQ(bind(listener.get(), reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  socklen_t length = sizeof(address);
  ASSERT_EQ(getsockname(listener.get(), reinterpret_cast<sockaddr*>(&address), &length), 0);
  UdpJson udp;
  ASSERT_EQ(udp.open(ntohs(address.sin_port)), 0);
  RecordedTick tick;
  tick.record.tick = 5;
  udp.send(tick);
  std::array<char, 4096> received;
  const ssize_t count = recv(listener.get(), received.data(), received.size(), 0);
  ASSERT_GT(count, 0);
  EXPECT_LT(count, 2000);
  EXPECT_EQ(nlohmann::json::parse(received.begin(), received.begin() + count).at("tick"), 5);

  UdpJson alone;
  ASSERT_EQ(alone.open(1), 0);
  for (int i = 0; i < 10; ++i) {
    alone.send(tick);
  }
  EXPECT_EQ(alone.failed(), 0U);
}

}  // namespace
}  // namespace tactus::firmware
