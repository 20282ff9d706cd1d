#include "drivers/falcon_usb/bring_up.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/unit/drivers/transcript.h"

namespace tactus::drivers {
namespace {

using Kind = FalconBringUp::Action::Kind;
using Outcome = FalconBringUp::Outcome;
constexpr hal::TimeNs kBringUpMs = 1'000'000;

std::vector<std::byte> image_of(std::size_t size) {
  std::vector<std::byte> image(size);
  for (std::size_t i = 0; i < size; ++i) {
    image[i] = static_cast<std::byte>(i * 37 + 11);
  }
  return image;
}

// Holds the state machine against a transcript, line by line.
class Player {
 public:
  explicit Player(std::span<const std::byte> firmware) : bring_up_(firmware) {
    bring_up_.start(now_ns_);
  }

  void play(const std::string& name) {
    for (const TranscriptLine& line : transcript(name)) {
      SCOPED_TRACE(name + ":" + std::to_string(line.number));
      play(line);
      if (::testing::Test::HasFailure()) {
        return;
      }
    }
  }

 private:
  void play(const TranscriptLine& line) {
    if (line.word == "control") {
      expect_control(line.rest);
    } else if (line.word == "out") {
      expect_bytes(letter_bytes(line.rest));
    } else if (line.word == "out#") {
      expect_bytes(hex_bytes(line.rest));
    } else if (line.word == "in") {
      hear(letter_bytes(line.rest));
    } else if (line.word == "in#") {
      hear(hex_bytes(line.rest));
    } else if (line.word == "echo") {
      hear(last_sent_);
    } else if (line.word == "chunk") {
      expect_chunk(std::stoul(line.rest));
    } else if (line.word == "silence") {
      expect_probes_in_vain(letter_bytes(line.rest));
    } else if (line.word == "up") {
      EXPECT_EQ(bring_up_.outcome(), Outcome::up);
    } else {
      FAIL() << "unknown word " << line.word;
    }
  }

  FalconBringUp::Action next() { return bring_up_.next(now_ns_); }

  void expect_control(const std::string& numbers) {
    const auto action = next();
    ASSERT_EQ(action.kind, Kind::control);
    EXPECT_EQ(action.setup.request_type, 0x40);
    EXPECT_EQ(action.setup.index, 0);
    std::istringstream words(numbers);
    unsigned request = 0;
    unsigned value = 0;
    words >> std::hex >> request >> value;
    EXPECT_EQ(action.setup.request, request);
    EXPECT_EQ(action.setup.value, value);
  }
  void expect_bytes(const std::vector<std::byte>& bytes) {
    const auto action = next();
    ASSERT_EQ(action.kind, Kind::send);
    last_sent_.assign(action.bytes.begin(), action.bytes.end());
    EXPECT_EQ(last_sent_, bytes);
    EXPECT_EQ(next().kind, Kind::nothing);  // until it is answered
  }
  void expect_chunk(std::size_t size) {
    const auto action = next();
    ASSERT_EQ(action.kind, Kind::send);
    ASSERT_EQ(action.bytes.size(), size);
    last_sent_.assign(action.bytes.begin(), action.bytes.end());
  }
  void expect_probes_in_vain(const std::vector<std::byte>& probe) {
    for (int i = 0; i < 100; ++i) {
      expect_bytes(probe);
      now_ns_ += 10 * kBringUpMs;
    }
    EXPECT_EQ(next().kind, Kind::nothing);  // the moment in which it gives up
  }
  void hear(const std::vector<std::byte>& bytes) {
    now_ns_ += kBringUpMs;
    bring_up_.take(bytes, now_ns_);
  }

  FalconBringUp bring_up_;
  hal::TimeNs now_ns_ = 5 * kBringUpMs;
  std::vector<std::byte> last_sent_;
};

TEST(FalconBringUp, FollowsTheTranscriptOfADeviceWithFirmware) {
  Player({}).play("falcon_with_firmware.txt");
}

TEST(FalconBringUp, FollowsTheTranscriptOfAnUpload) {
  const auto image = image_of(130);
  Player(image).play("falcon_upload.txt");
}

// Runs a bring-up to its end. `device` answers each action.
template <class Device>
FalconBringUp run_bring_up(std::span<const std::byte> firmware, Device device) {
  FalconBringUp bring_up(firmware);
  hal::TimeNs now_ns = 0;
  bring_up.start(now_ns);
  for (int i = 0; i < 200'000 && bring_up.outcome() == Outcome::under_way; ++i) {
    const auto action = bring_up.next(now_ns);
    if (action.kind == Kind::nothing) {
      now_ns += kBringUpMs;
    } else {
      device(bring_up, action, now_ns);
    }
  }
  return bring_up;
}

TEST(FalconBringUp, SaysThatTheFirmwareIsMissingWhenNoneIsGiven) {
  const auto end = run_bring_up({}, [](auto&...) {});
  EXPECT_EQ(end.outcome(), Outcome::no_firmware);
}

TEST(FalconBringUp, SaysThatTheLoaderIsSilent) {
  const auto image = image_of(100);
  const auto end = run_bring_up(image, [](auto&...) {});
  EXPECT_EQ(end.outcome(), Outcome::no_loader);
}

TEST(FalconBringUp, SaysThatSettingsAreRefused) {
  const auto end = run_bring_up(
      {}, [](auto& bring_up, const auto&, hal::TimeNs now_ns) { bring_up.refused(now_ns); });
  EXPECT_EQ(end.outcome(), Outcome::refuses_settings);
}

// A loader that answers, and sends back what `echo` makes of each byte.
template <class Echo>
auto loader(Echo echo) {
  return [echo, count = 0](FalconBringUp& bring_up, const FalconBringUp::Action& action,
                           hal::TimeNs now_ns) mutable {
    if (action.kind != Kind::send || action.bytes[0] == std::byte{'<'}) {
      return;
    }
    const std::vector<std::byte> sent(action.bytes.begin(), action.bytes.end());
    if (sent == hex_bytes("0A 43 0D")) {
      bring_up.take(hex_bytes("0A 44 2C 0D"), now_ns);
    } else {
      std::vector<std::byte> back = sent;
      std::ranges::transform(sent, back.begin(),
                             [&](std::byte byte) { return echo(byte, count++); });
      bring_up.take(back, now_ns);
    }
  };
}

TEST(FalconBringUp, TriesTheWholeUploadTenTimesWhenTheEchoIsWrong) {
  const auto image = image_of(500);
  int byte_count = 0;
  const auto end = run_bring_up(image, loader([&byte_count](std::byte byte, int) {
                                  ++byte_count;
                                  return byte_count % 300 == 299 ? byte ^ std::byte{4} : byte;
                                }));
  EXPECT_EQ(end.outcome(), Outcome::load_failed);
  EXPECT_EQ(end.attempt(), 10U);
}

TEST(FalconBringUp, OneWrongEchoCostsOneAttempt) {
  const auto image = image_of(500);
  const auto end = run_bring_up(image, loader([](std::byte byte, int count) {
                                  return count == 100 ? byte ^ std::byte{1} : byte;
                                }));
  EXPECT_EQ(end.attempt(), 2U);
  EXPECT_EQ(end.loaded_bytes(), image.size());
  EXPECT_EQ(end.outcome(), Outcome::firmware_silent);  // this loader never starts what it loaded
}

}  // namespace
}  // namespace tactus::drivers
