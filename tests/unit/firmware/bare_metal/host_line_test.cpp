#include "firmware/bare_metal/host_line.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "firmware/bare_metal/board_loop.h"
#include "rendering/scene/image_format.h"
#include "tests/support/without_sign_check.h"
#include "tests/unit/firmware/bare_metal/fake_board.h"
#include "tests/unit/firmware/test_scene.h"

namespace tactus::firmware {
namespace {

using hal::fake_board;

// Half a second.
constexpr int kTimeoutTicks = 500;

// A device at rest above the floor.
struct StillDevice {
  static std::size_t joint_count() { return kJointCount; }
  static void read(drivers::JointSample& sample) {
    sample = {};
    sample.position[1] = 0.05;
  }
  static std::uint32_t write(const drivers::JointCommand& /*command*/) {
    return drivers::kDeviceOk;
  }
  static void clear_faults() {}
};

// A loop on the board in memory, and the host at the other end of its UART.
class HostLineTest : public ::testing::Test {
 protected:
  HostLineTest() {
    hal::power_up_fake_board();
    EXPECT_TRUE(controller_->configure(testing::without_sign_check(cartesian_config())));
    EXPECT_TRUE(controller_->load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  }

  template <class Message>
  void say(const Message& message) {
    std::array<std::byte, kMaxMessage> room{};
    put_frame(write_message(message, room),
              [](std::byte byte) { fake_board().received.push_back(static_cast<char>(byte)); });
  }

  // Runs ticks, and takes what the board has sent. The first call starts the board: it hears what
  // the host has said before.
  void run(int ticks) {
    if (!is_started_) {
      loop_.start();
      is_started_ = true;
    }
    for (int i = 0; i < ticks; ++i) {
      loop_.turn();
      for (const char character : fake_board().sent) {
        const Heard heard = reader_.take(static_cast<std::byte>(character));
        text_ += heard.text;
        if (!heard.message.empty()) {
          take(heard.message);
        }
      }
      fake_board().sent.clear();
    }
  }

  void take(std::span<const std::byte> message) {
    EXPECT_LE(type_of(message), MessageType::image_part) << "a host's message comes from the board";
    if (RecordedTick tick; read_message(message, tick)) {
      ticks_.push_back(tick);
    }
    if (Answer answer; read_message(message, answer)) {
      answers_.push_back(answer);
    }
    if (Hello hello; read_message(message, hello)) {
      hellos_.push_back(hello);
    }
    if (ImagePart part; read_message(message, part)) {
      EXPECT_EQ(part.image, BoardImage::scene);
      parts_.push_back(part.offset);
      image_.insert(image_.end(), part.bytes.begin(), part.bytes.end());
    }
  }

  // Returns the only answer of so many ticks.
  Answer answer_within(int ticks) {
    answers_.clear();
    run(ticks);
    EXPECT_EQ(answers_.size(), 1U);
    return answers_.empty() ? Answer{} : answers_.front();
  }

  [[nodiscard]] const TelemetryRecord& record() const { return controller_->record(); }

  // An image that begins with a header, so to speak, and that no part of kImagePartBytes ends.
  std::vector<std::byte> scene_image_ = [] {
    std::vector<std::byte> bytes(3 * kImagePartBytes + 17);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
      bytes[i] = static_cast<std::byte>(i * i / 7);
    }
    return bytes;
  }();
  Floor floor_{{.stiffness_N_per_m = 500.0, .damping_Ns_per_m = 0.0, .friction = {}}};
  std::unique_ptr<Controller> controller_ = std::make_unique<Controller>();
  StillDevice device_;
  BoardLoop<StillDevice> loop_{*controller_,
                               device_,
                               {.board = "desk",
                                .device_image = {},
                                .scene_image = scene_image_,
                                .rate_hz = 1000.0,
                                .joints = kJointCount}};

  bool is_started_ = false;
  FrameReader reader_;
  std::string text_;
  std::vector<RecordedTick> ticks_;
  std::vector<Answer> answers_;
  std::vector<Hello> hellos_;
  std::vector<std::uint32_t> parts_;
  std::vector<std::byte> image_;
};

TEST_F(HostLineTest, WithoutAHostTheBoardTellsItsLinesAloneAndGoesToForce) {
  run(2000);
  EXPECT_EQ(record().mode, Mode::active);
  EXPECT_TRUE(fake_board().has_power);
  EXPECT_EQ(fake_board().fed, 2000U);
  EXPECT_EQ(std::ranges::count(text_, '\n'), 4) << text_;
  EXPECT_EQ(text_.find('\0'), std::string::npos);
  EXPECT_TRUE(ticks_.empty() && answers_.empty() && hellos_.empty());
}

TEST_F(HostLineTest, WithoutAHostTheFirstTickComesAfterAQuarterOfASecond) {
  run(1);
  EXPECT_EQ(hal::now_ns(), 251 * hal::kFakePeriod_ns);
  EXPECT_EQ(record().tick, 0U);
  EXPECT_EQ(record().missed_ticks, 0U);
  EXPECT_FALSE(fake_board().has_power);
}

TEST_F(HostLineTest, AHostThatOnlySaysHelloIsWaitedForAsLong) {
  say(AskHello{});
  run(1);
  EXPECT_EQ(hal::now_ns(), 251 * hal::kFakePeriod_ns);
  EXPECT_EQ(hellos_.size(), 1U);
}

TEST_F(HostLineTest, AHelloTellsWhatTheBoardIs) {
  run(7);
  say(AskHello{});
  run(1);
  ASSERT_EQ(hellos_.size(), 1U);
  const Hello& hello = hellos_.front();
  EXPECT_EQ(text_of(hello.board), "desk");
  EXPECT_EQ(text_of(hello.profile), rendering::kProfile.name);
  EXPECT_EQ(hello.rate_hz, 1000.0);
  EXPECT_EQ(hello.joints, kJointCount);
  EXPECT_EQ(hello.scene.bytes, scene_image_.size());
  EXPECT_EQ(hello.scene.checksum, rendering::header_checksum(scene_image_));
  EXPECT_EQ(hello.device.bytes, 0U);
  EXPECT_EQ(hello.next_tick, 8U);
  EXPECT_EQ(hello.most_waiting, kMaxWaiting);
  EXPECT_EQ(hello.lost_bytes, hal::kFakeLostChars);
  EXPECT_EQ(hello.broken_frames, 0U);
  run(5);
  EXPECT_EQ(hellos_.size(), 1U);
}

TEST_F(HostLineTest, EveryTickThatWasAskedForComesWithItsRecord) {
  say(AskTicks{.every = 1});
  run(1500);
  ASSERT_EQ(ticks_.size(), 1500U);
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    EXPECT_EQ(ticks_[i].record.tick, i);
    EXPECT_EQ(ticks_[i].dropped, 0U);
    EXPECT_EQ(ticks_[i].joint_count, kJointCount);
    EXPECT_EQ(ticks_[i].loop.scheduled_ns,
              static_cast<std::int64_t>((i + 1) * hal::kFakePeriod_ns));
    EXPECT_EQ(ticks_[i].loop.wake_latency_ns(), 0);
  }
  EXPECT_EQ(ticks_.back().record.state_hash, record().state_hash);
  EXPECT_NE(text_.find("tick 1000 hash "), std::string::npos) << "the lines are told as before";
  say(AskTicks{.every = 0});
  run(10);
  EXPECT_EQ(ticks_.size(), 1500U);
}

TEST_F(HostLineTest, OfEveryTenthTickTheNumbersAreMultiplesOfTen) {
  run(3);
  say(AskTicks{.every = 10});
  run(100);
  ASSERT_EQ(ticks_.size(), 10U);
  EXPECT_EQ(ticks_.front().record.tick, 10U);
  EXPECT_EQ(ticks_.back().record.tick, 100U);
}

TEST_F(HostLineTest, OnASlowLineATickArrivesInFullOrIsCountedAsDropped) {
  // The UART takes a twentieth of a tick's frame in a tick.
  fake_board().offers_per_char = 0;
  say(AskTicks{.every = 1});
  std::uint64_t last = 0;
  for (int i = 0; i < 4000; ++i) {
    fake_board().offers_per_char = i % 20 == 0 ? 1 : 0;
    run(1);
  }
  ASSERT_GT(ticks_.size(), 100U);
  ASSERT_LT(ticks_.size(), 4000U);
  EXPECT_EQ(reader_.broken(), 0U);
  for (const RecordedTick& tick : ticks_) {
    if (tick.record.tick > 0) {
      EXPECT_GT(tick.record.tick, last);
      EXPECT_EQ(tick.dropped, tick.record.tick - static_cast<std::uint64_t>(&tick - ticks_.data()))
          << "the others were left out";
    }
    last = tick.record.tick;
  }
}

TEST_F(HostLineTest, ASetParameterIsAnsweredWithTheTickThatHadIt) {
  run(100);
  const ParameterChange change{.place = {.parameter = Parameter::max_force}, .value = 3.0};
  say(AskTicks{.every = 1});
  say(Command{.kind = CommandKind::set, .ticket = 77, .change = change});
  const Answer answer = answer_within(3);
  EXPECT_EQ(answer.ticket, 77U);
  EXPECT_EQ(answer.kind, CommandKind::set);
  EXPECT_EQ(answer.outcome, Outcome::done);
  EXPECT_EQ(answer.value.value, 3.0);
  EXPECT_EQ(answer.tick, 100U);
  ASSERT_EQ(ticks_.size(), 3U);
  EXPECT_EQ(ticks_[0].record.tick, 100U);
  EXPECT_EQ(ticks_[0].record.change.place.parameter, Parameter::max_force);
  EXPECT_EQ(ticks_[0].record.change.value, 3.0);
  EXPECT_EQ(ticks_[1].record.change.place.parameter, Parameter::none);
}

TEST_F(HostLineTest, ARefusalSaysWhy) {
  say(Command{.kind = CommandKind::set,
              .ticket = 1,
              .change = {.place = {.parameter = Parameter::max_force}, .value = 1e3}});
  const Answer answer = answer_within(1);
  EXPECT_EQ(answer.outcome, Outcome::parameter);
  EXPECT_EQ(answer.refusal, ParameterRefusal::out_of_range);
}

TEST_F(HostLineTest, CommandsKeepTheirOrderAndOneFollowsTheOtherByATick) {
  for (Ticket ticket = 1; ticket <= kMaxWaiting + 5; ++ticket) {
    say(Command{.kind = CommandKind::look, .ticket = ticket});
  }
  run(40);
  ASSERT_GE(answers_.size(), kMaxWaiting);
  ASSERT_LT(answers_.size(), kMaxWaiting + 5) << "more than a hello allows are left out";
  for (std::size_t i = 0; i < answers_.size(); ++i) {
    EXPECT_EQ(answers_[i].tick, i);
    if (i > 0) {
      EXPECT_GT(answers_[i].ticket, answers_[i - 1].ticket);
    }
  }
}

TEST_F(HostLineTest, AfterTheFirstRequestOnlyTheHostAsks) {
  run(1000);
  ASSERT_EQ(record().mode, Mode::active);
  say(Command{.kind = CommandKind::request, .ticket = 5, .request = Request::disable});
  const Answer answer = answer_within(1000);
  EXPECT_EQ(answer.outcome, Outcome::done);
  EXPECT_EQ(answer.before, Mode::active);
  EXPECT_EQ(answer.after, Mode::ready);
  EXPECT_EQ(record().mode, Mode::ready) << "nothing enables it again";
  EXPECT_FALSE(fake_board().has_power);
  say(Command{.kind = CommandKind::request, .ticket = 6, .request = Request::enable});
  EXPECT_EQ(answer_within(10).after, Mode::active);
}

TEST_F(HostLineTest, AStopGoesBeforeWhatWaitsAndTakesThePower) {
  run(1000);
  ASSERT_TRUE(fake_board().has_power);
  for (Ticket ticket = 1; ticket <= 5; ++ticket) {
    say(Command{.kind = CommandKind::look, .ticket = ticket});
  }
  say(LineStop{.ticket = 9});
  run(1);
  EXPECT_FALSE(fake_board().has_power);
  EXPECT_EQ(record().faults, kFaultOperatorStop);
  ASSERT_EQ(answers_.size(), 2U) << "the first command, and the stop before the other four";
  EXPECT_EQ(answers_[0].ticket, 9U);
  EXPECT_EQ(answers_[0].kind, CommandKind::request);
  EXPECT_EQ(answers_[0].request, Request::estop);
  EXPECT_EQ(answers_[0].outcome, Outcome::done);
  EXPECT_EQ(answers_[0].before, Mode::active);
  EXPECT_EQ(answers_[0].after, Mode::fault);
  EXPECT_EQ(answers_[0].tick, 1000U);
  EXPECT_EQ(answers_[1].ticket, 1U);
  run(4);
  EXPECT_EQ(answers_.size(), 6U);
  EXPECT_NE(text_.find("fault 9 operator_stop tick 1001"), std::string::npos) << text_;
}

TEST_F(HostLineTest, AnAnswerWaitsUntilTheLineHasRoom) {
  say(AskTicks{.every = 1});
  fake_board().offers_per_char = 0;
  run(20);
  say(Command{.kind = CommandKind::look, .ticket = 3});
  say(LineStop{.ticket = 4});
  for (int i = 0; i < 20; ++i) {
    say(Command{.kind = CommandKind::look, .ticket = static_cast<Ticket>(100 + i)});
    run(1);
  }
  EXPECT_TRUE(answers_.empty());
  fake_board().offers_per_char = 1;
  run(30);
  ASSERT_EQ(answers_.size(), 22U);
  EXPECT_EQ(answers_[0].ticket, 4U);
  EXPECT_EQ(answers_[1].ticket, 3U);
}

TEST_F(HostLineTest, ALostLineTakesThePowerWithinHalfASecond) {
  run(1000);
  say(Alive{});
  say(AskTicks{.every = 1});
  run(kTimeoutTicks);
  EXPECT_EQ(record().faults, kNoFault);
  EXPECT_TRUE(fake_board().has_power);
  run(1);
  EXPECT_EQ(record().faults, kFaultLineLost);
  EXPECT_EQ(record().loop_status, kLoopLineLost);
  EXPECT_FALSE(fake_board().has_power);
  EXPECT_NE(text_.find("fault 46 line_lost tick 1501"), std::string::npos) << text_;
  ASSERT_EQ(ticks_.size(), 501U);
  EXPECT_EQ(ticks_.back().record.faults, kFaultLineLost) << "a recording ends with it";
  ticks_.clear();
  run(1000);
  EXPECT_TRUE(ticks_.empty()) << "nobody hears them";
  EXPECT_EQ(record().mode, Mode::fault);
  say(Command{.kind = CommandKind::request, .ticket = 8, .request = Request::reset});
  EXPECT_EQ(answer_within(2).outcome, Outcome::done) << "a host that is back may go on";
  EXPECT_EQ(record().faults, kNoFault);
}

TEST_F(HostLineTest, ATickWithTheLostLineIsSentOnceThereIsRoom) {
  say(Alive{});
  say(AskTicks{.every = 1});
  run(kTimeoutTicks - 10);
  fake_board().offers_per_char = 0;
  run(20);
  ticks_.clear();
  fake_board().offers_per_char = 1;
  run(1000);
  ASSERT_EQ(ticks_.size(), 2U) << "the one that waited, and the first after it";
  EXPECT_EQ(ticks_.back().record.faults, kFaultLineLost);
}

TEST_F(HostLineTest, AnyMessageKeepsTheLineAndNothingElseDoes) {
  run(1000);
  say(Alive{});
  for (int i = 0; i < 5; ++i) {
    run(kTimeoutTicks);
    say(AskHello{});
  }
  run(1);
  EXPECT_EQ(record().faults, kNoFault);
  // Noise, text, a frame of the board's own kind, and one that is cut are no messages of a host.
  for (int i = 0; i < kTimeoutTicks; ++i) {
    for (const char character : std::string("noise\r\n\0\0x", 10)) {
      fake_board().received.push_back(character);
    }
    say(Hello{});
    say(AskTicks{});
    fake_board().received.pop_back();
    fake_board().received.back() = '!';
    run(1);
  }
  EXPECT_EQ(record().faults, kFaultLineLost);
}

TEST_F(HostLineTest, WithoutAliveASilentHostIsNoFault) {
  say(AskHello{});
  say(AskTicks{.every = 1});
  run(4 * kTimeoutTicks);
  EXPECT_EQ(record().faults, kNoFault);
}

TEST_F(HostLineTest, AReleaseEndsTheSupervisionAndTheTicks) {
  say(Alive{});
  say(AskTicks{.every = 1});
  run(100);
  say(Release{});
  ticks_.clear();
  run(4 * kTimeoutTicks);
  EXPECT_EQ(record().faults, kNoFault);
  EXPECT_TRUE(ticks_.empty());
}

TEST_F(HostLineTest, AnImageArrivesInItsOrderAndEndsWhereItEnds) {
  say(AskImage{.image = BoardImage::scene, .offset = 0, .bytes = 1U << 30U});
  run(20);
  EXPECT_EQ(parts_, (std::vector<std::uint32_t>{0, 512, 1024, 1536}));
  EXPECT_EQ(image_, scene_image_);
  parts_.clear();
  image_.clear();
  say(AskImage{.image = BoardImage::scene, .offset = 100, .bytes = 600});
  run(20);
  EXPECT_TRUE(std::ranges::equal(image_, std::span(scene_image_).subspan(100, 600)));
  parts_.clear();
  image_.clear();
  say(AskImage{.image = BoardImage::scene, .offset = 0xFFFF'FFFF, .bytes = 600});
  run(20);
  EXPECT_EQ(parts_.size(), 1U) << "a part without bytes says that there are none";
  EXPECT_TRUE(image_.empty());
}

TEST_F(HostLineTest, OnASlowLineEveryPartOfAnImageArrives) {
  say(AskImage{.image = BoardImage::scene, .offset = 0, .bytes = 1U << 20U});
  say(AskTicks{.every = 1});
  for (int i = 0; i < 1000; ++i) {
    fake_board().offers_per_char = i % 7 == 0 ? 1 : 0;
    run(1);
  }
  EXPECT_EQ(image_, scene_image_);
}

TEST_F(HostLineTest, CharactersThatCannotBeHeardInATickAreHeardInTheNext) {
  run(1);
  for (int i = 0; i < 2 * kMostHeardCharacters; ++i) {
    fake_board().received.push_back('x');
  }
  say(AskHello{});
  run(1);
  EXPECT_EQ(fake_board().received.size(), kMostHeardCharacters + 8U);
  run(1);
  EXPECT_TRUE(hellos_.empty());
  run(1);
  EXPECT_EQ(hellos_.size(), 1U);
}

TEST_F(HostLineTest, TheHashesAreTheSameWithAHostThatOnlyListens) {
  run(1000);
  const std::uint64_t alone = record().state_hash;
  ASSERT_TRUE(controller_->configure(testing::without_sign_check(cartesian_config())));
  ASSERT_TRUE(controller_->load_scene(floor_.objects(), {.tool_radius_m = 0.0}));
  say(AskHello{});
  say(AskTicks{.every = 1});
  for (int i = 0; i < 10; ++i) {
    say(Alive{});
    say(Command{.kind = CommandKind::look, .ticket = 1});
    run(100);
  }
  EXPECT_EQ(record().state_hash, alone);
  EXPECT_EQ(ticks_.size(), 1000U);
}

}  // namespace
}  // namespace tactus::firmware
