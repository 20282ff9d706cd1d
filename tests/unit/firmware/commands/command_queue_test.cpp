#include "firmware/commands/command_queue.h"

#include <gtest/gtest.h>

#include <string>

#include "firmware/control/parameter_choices.h"
#include "firmware/linux/commands/reply.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

// A command queue and a controller over a floor, without a thread; tick() takes the commands.
class CommandQueueTest : public ::testing::Test {
 protected:
  CommandQueueTest() {
    EXPECT_TRUE(controller_.configure(cartesian_config()));
    EXPECT_TRUE(controller_.load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  }

  void tick() {
    drivers::JointSample sample;
    sample.position[1] = 0.05;
    sample.status = status_;
    controller_.tick(sample, queue_.before_tick(controller_));
    queue_.after_tick(controller_);
  }

  // The answer to a request after one tick.
  Answer answer_to(Request request) {
    EXPECT_FALSE(queue_.post({.kind = CommandKind::request, .ticket = 9, .request = request}));
    tick();
    return queue_.next_answer().value_or(Answer{});
  }

  std::string reply_to(Request request) {
    TextLine line;
    write_request_reply(line, answer_to(request), "");
    return std::string(line.text());
  }

  Floor floor_{{.stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0, .friction = {}}};
  Controller controller_;
  CommandQueue queue_;
  std::uint32_t status_ = drivers::kDeviceOk;
};

TEST_F(CommandQueueTest, ARequestIsAnsweredWithTheTickThatTookIt) {
  tick();
  tick();
  const Answer answer = answer_to(Request::home);
  EXPECT_EQ(answer.ticket, 9U);
  EXPECT_EQ(answer.tick, 2U);
  EXPECT_EQ(answer.outcome, Outcome::done);
  EXPECT_EQ(answer.before, Mode::init);
  EXPECT_EQ(answer.after, Mode::homing);
  EXPECT_FALSE(queue_.next_answer());
}

TEST_F(CommandQueueTest, RequestsGoTheWayToActiveAndBack) {
  EXPECT_EQ(reply_to(Request::home), "ok home tick=0 mode=homing\n");
  tick();
  EXPECT_EQ(reply_to(Request::enable), "ok enable tick=2 mode=active\n");
  EXPECT_EQ(reply_to(Request::disable), "ok disable tick=3 mode=ready\n");
  EXPECT_EQ(reply_to(Request::estop), "ok estop tick=4 mode=fault\n");
  EXPECT_EQ(reply_to(Request::reset), "ok reset tick=5 mode=init\n");
}

TEST_F(CommandQueueTest, ARefusalSaysWhatStandsInTheWayAndWhatToDo) {
  EXPECT_EQ(reply_to(Request::enable),
            "refused enable tick=0 mode=init: the mode is init; send home first\n");
  status_ = drivers::kDeviceHoming;
  reply_to(Request::home);
  EXPECT_EQ(
      reply_to(Request::enable),
      "refused enable tick=2 mode=homing: the mode is homing; homing is under way; wait until "
      "the mode is ready\n");
  status_ = drivers::kDeviceDriveFault;
  EXPECT_EQ(reply_to(Request::home),
            "refused home tick=3 mode=fault: the mode is fault (drive); send reset first\n");
  EXPECT_EQ(reply_to(Request::reset),
            "refused reset tick=4 mode=fault: the mode is fault (drive); remove the cause, then "
            "send reset "
            "again\n");
}

TEST_F(CommandQueueTest, ARequestThatANewerOneReplacesIsAnsweredAtOnce) {
  queue_.post({.kind = CommandKind::request, .ticket = 1, .request = Request::home});
  const auto replaced =
      queue_.post({.kind = CommandKind::request, .ticket = 2, .request = Request::estop});
  ASSERT_TRUE(replaced);
  EXPECT_EQ(replaced->ticket, 1U);
  EXPECT_EQ(replaced->outcome, Outcome::superseded);
  const auto refused =
      queue_.post({.kind = CommandKind::request, .ticket = 3, .request = Request::enable});
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->ticket, 3U);
  EXPECT_EQ(refused->outcome, Outcome::estop_waits);
  tick();
  EXPECT_EQ(queue_.next_answer()->ticket, 2U);
  EXPECT_EQ(controller_.mode(), Mode::fault);
}

TEST_F(CommandQueueTest, ParametersKeepTheirOrderOneATickAndAreInItsRecord) {
  const ParameterPlace force{.parameter = Parameter::max_force};
  queue_.post({.kind = CommandKind::set, .ticket = 1, .change = {.place = force, .value = 4.0}});
  queue_.post({.kind = CommandKind::set, .ticket = 2, .change = {.place = force, .value = 3.0}});
  queue_.post({.kind = CommandKind::get, .ticket = 3, .change = {.place = force}});
  for (const double value : {4.0, 3.0}) {
    tick();
    EXPECT_EQ(controller_.record().change.place, force);
    EXPECT_EQ(controller_.record().change.value, value);
    EXPECT_EQ(queue_.next_answer()->tick, controller_.record().tick);
  }
  tick();
  EXPECT_EQ(controller_.record().change.place.parameter, Parameter::none);
  const Answer read = *queue_.next_answer();
  EXPECT_EQ(read.ticket, 3U);
  EXPECT_EQ(read.value.value, 3.0);
}

TEST_F(CommandQueueTest, ThereIsRoomAgainAsSoonAsAnAnswerIsTaken) {
  Ticket last = 0;
  while (queue_.has_room()) {
    queue_.post({.kind = CommandKind::look, .ticket = ++last});
  }
  EXPECT_EQ(last, kMaxWaiting);
  tick();
  EXPECT_FALSE(queue_.has_room());
  EXPECT_EQ(queue_.next_answer()->ticket, 1U);
  ASSERT_TRUE(queue_.has_room());
  queue_.post({.kind = CommandKind::look, .ticket = ++last});
  for (Ticket ticket = 2; ticket <= last; ++ticket) {
    tick();
    EXPECT_EQ(queue_.next_answer()->ticket, ticket);
  }
  EXPECT_FALSE(queue_.next_answer());
}

TEST_F(CommandQueueTest, RequestsNeedNoRoom) {
  while (queue_.has_room()) {
    queue_.post({.kind = CommandKind::look});
  }
  for (std::size_t i = 0; i < kMaxRequests; ++i) {
    queue_.post({.kind = CommandKind::request, .request = Request::estop});
    tick();
  }
  std::size_t stops = 0;
  while (const auto answer = queue_.next_answer()) {
    stops += answer->kind == CommandKind::request ? 1U : 0U;
  }
  EXPECT_EQ(stops, kMaxRequests);
}

TEST_F(CommandQueueTest, AParameterOutOfRangeIsRefusedWithItsRange) {
  const ParameterPlace force{.parameter = Parameter::max_force};
  queue_.post({.kind = CommandKind::set, .ticket = 1, .change = {.place = force, .value = 1e3}});
  tick();
  TextLine line;
  write_parameter_reply(line, "set", force, *queue_.next_answer());
  EXPECT_EQ(line.text(), "refused set: the value is out of its range, 0 to 10\n");
}

TEST_F(CommandQueueTest, AnInjectionIsForTheDevice) {
  queue_.post({.kind = CommandKind::inject,
               .ticket = 1,
               .injection = {.injection = Injection::lost, .ticks = 1}});
  tick();
  drivers::JointSample sample;
  queue_.injector().change(sample, 1000.0);
  EXPECT_EQ(sample.status, drivers::kDeviceLost);
}

TEST_F(CommandQueueTest, WhatTookEffectIsToldAsAnEvent) {
  EventRing events;
  queue_.set_events({.to = &events, .tell = [](void* to, const TelemetryEvent& event) {
                       static_cast<EventRing*>(to)->push(event);
                     }});
  const ParameterPlace damping{.parameter = Parameter::damping, .object = 0};
  queue_.post({.kind = CommandKind::set, .ticket = 1, .change = {.place = damping, .value = 2.0}});
  answer_to(Request::home);
  const TelemetryEvent* const front = events.front();
  ASSERT_NE(front, nullptr);
  const TelemetryEvent first = *front;
  events.pop();
  const TelemetryEvent* const second = events.front();
  ASSERT_NE(second, nullptr);
  EXPECT_EQ(first.kind, EventKind::parameter);
  EXPECT_EQ(name_of(first), "object.0.damping_Ns_per_m");
  EXPECT_EQ(first.value, 2.0);
  EXPECT_EQ(first.tick, 0U);
  EXPECT_EQ(name_of(*second), "home");
}

TEST_F(CommandQueueTest, IsOperatedFromTheFirstRequestOn) {
  tick();
  EXPECT_FALSE(queue_.is_operated());
  answer_to(Request::disable);
  EXPECT_TRUE(queue_.is_operated());
}

TEST_F(CommandQueueTest, AParameterWithNamesIsToldByThem) {
  const ParameterPlace contact{.parameter = Parameter::contact};
  const auto reply_to_set = [&](CommandKind kind, double value) {
    queue_.post({.kind = kind, .ticket = 9, .change = {.place = contact, .value = value}});
    tick();
    TextLine line;
    write_parameter_reply(line, kind == CommandKind::set ? "set" : "get", contact,
                          queue_.next_answer().value_or(Answer{}));
    return std::string(line.text());
  };
  const std::string choices =
      " choices=sphere_proxy,god_object,one_plane,three_sub_goals,three_step,one_step\n";
  EXPECT_EQ(reply_to_set(CommandKind::get, 0.0),
            "ok get tick=0 object.0.contact=sphere_proxy" + choices);
  EXPECT_EQ(reply_to_set(CommandKind::set, 5.0),
            "ok set tick=1 object.0.contact=one_plane" + choices);
  EXPECT_EQ(
      reply_to_set(CommandKind::set, kNoChoice),
      "refused set: there is no such value, or the object's shape, motion, friction, grain or "
      "textures do not go with it; write one of sphere_proxy,god_object,one_plane,"
      "three_sub_goals,three_step,one_step\n");
}

}  // namespace
}  // namespace tactus::firmware
