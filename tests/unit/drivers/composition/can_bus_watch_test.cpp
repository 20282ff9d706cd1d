#include "drivers/composition/can_bus_watch.h"

#include <gtest/gtest.h>

namespace tactus::drivers {
namespace {

using hal::ErrorCode;

hal::CanReceived report(std::uint32_t classes) {
  hal::CanReceived received;
  received.kind = hal::CanReceived::Kind::error;
  received.error.classes = classes;
  return received;
}

TEST(CanBusWatch, AControllerThatGoesOffTheBusIsALostDeviceAtOnce) {
  CanBusWatch watch;
  watch.take(report(hal::kCanController | hal::kCanBusError));
  EXPECT_EQ(watch.status(), kDeviceOk);
  watch.take(report(hal::kCanBusOff));
  EXPECT_EQ(watch.status(), kDeviceLost);
  EXPECT_TRUE(watch.is_off_the_bus());
  EXPECT_NE(watch.trouble().what.find("off the bus"), std::string_view::npos);
}

TEST(CanBusWatch, AQueueThatIsFullThreeTimesInARowIsALostDeviceAndTwiceIsNot) {
  CanBusWatch watch;
  for (int round = 0; round < 3; ++round) {
    watch.note_sent(hal::failure(ErrorCode::queue_full), 4);
    watch.note_sent(std::size_t{3}, 4);  // not all of them
    EXPECT_EQ(watch.status(), kDeviceOk);
    watch.note_sent(std::size_t{4}, 4);
  }
  for (int i = 0; i < 3; ++i) {
    watch.note_sent(hal::failure(ErrorCode::queue_full), 4);
  }
  EXPECT_EQ(watch.status(), kDeviceLost);
  EXPECT_FALSE(watch.is_off_the_bus());
}

TEST(CanBusWatch, EveryOtherErrorIsALostDeviceButATimeoutIsNone) {
  CanBusWatch patient;
  patient.note_received({ErrorCode::timeout, 0});
  patient.note({});
  EXPECT_EQ(patient.status(), kDeviceOk);
  for (const ErrorCode code : {ErrorCode::link_down, ErrorCode::disconnected, ErrorCode::io}) {
    CanBusWatch sending;
    sending.note_sent(hal::failure(code), 1);
    CanBusWatch receiving;
    receiving.note_received({code, 0});
    CanBusWatch filtering;
    filtering.note(hal::failure(code));
    for (const CanBusWatch* watch : {&sending, &receiving, &filtering}) {
      EXPECT_EQ(watch->status(), kDeviceLost) << hal::words(code);
      EXPECT_FALSE(watch->trouble().remedy.empty()) << hal::words(code);
    }
  }
}

TEST(CanBusWatch, KeepsTheWordsOfItsFirstTrouble) {
  CanBusWatch watch;
  watch.note_sent(hal::failure(ErrorCode::link_down, 100), 1);
  watch.take(report(hal::kCanBusOff));
  EXPECT_NE(watch.trouble().what.find("down"), std::string_view::npos);
  EXPECT_EQ(watch.trouble().code, 100U);
  EXPECT_TRUE(watch.is_off_the_bus());
}

}  // namespace
}  // namespace tactus::drivers
