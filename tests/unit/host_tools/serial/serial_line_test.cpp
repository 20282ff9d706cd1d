#include "host_tools/serial/serial_line.h"

#include <asm/termbits.h>
#include <gtest/gtest.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string>

#include "host_tools/input_error.h"
#include "host_tools/remote/remote.h"
#include "tests/support/folder_test.h"
#include "tests/unit/host_tools/serial/pseudo_terminal.h"

namespace tactus::host {
namespace {

constexpr hal::TimeNs kLinePatience_ns = 5 * hal::kNsPerSecond;

std::string wire_text(std::span<const std::byte> bytes) {
  std::string text;
  std::ranges::transform(bytes, std::back_inserter(text),
                         [](std::byte byte) { return static_cast<char>(byte); });
  return text;
}

std::span<const std::byte> wire_bytes(const std::string& text) {
  return std::as_bytes(std::span(text));
}

// Reads until `count` bytes have come.
std::string read_text(SerialLine& line, std::size_t count) {
  std::string text;
  std::array<std::byte, 64> room{};
  const hal::TimeNs deadline_ns = hal::monotonic_now_ns() + kLinePatience_ns;
  while (text.size() < count && hal::monotonic_now_ns() < deadline_ns) {
    text += wire_text(std::span(room).first(line.read(room, deadline_ns)));
  }
  return text;
}

// The text of the error with which a place cannot be opened.
std::string opening_refusal(const SerialPlace& place) {
  try {
    const SerialLine line(place);
  } catch (const UnreachableError& error) {
    return error.what();
  }
  return "";
}

TEST(SerialPlaceTest, ANumberBehindTheLastColonIsTheRate) {
  EXPECT_EQ(parse_serial_place("/dev/ttyUSB0:115200").path, "/dev/ttyUSB0");
  EXPECT_EQ(parse_serial_place("/dev/ttyUSB0:115200").baud, 115200U);
  EXPECT_EQ(parse_serial_place("/dev/ttyUSB0").baud, kDefaultBaud);
  const std::string by_path = "/dev/serial/by-path/pci-0000:00:14.0-usb-0:2:1.0-port0";
  EXPECT_EQ(parse_serial_place(by_path).path, by_path);
  EXPECT_EQ(parse_serial_place(by_path + ":9600").path, by_path);
}

TEST(SerialPlaceTest, ASocketHasNoRate) {
  const SerialPlace place = parse_serial_place("unix:/tmp/board:9600");
  EXPECT_TRUE(place.is_socket);
  EXPECT_EQ(place.path, "/tmp/board:9600");
}

TEST(SerialPlaceTest, ARateThatNoUartHasIsRefusedWithTheRange) {
  for (const char* text : {"/dev/ttyUSB0:0", "/dev/ttyUSB0:99999999999", "/dev/ttyUSB0:300"}) {
    try {
      parse_serial_place(text);
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("from 1200 to 12000000"), std::string::npos);
    }
  }
  EXPECT_THROW(parse_serial_place(""), InputError);
  EXPECT_THROW(parse_serial_place("unix:"), InputError);
}

class SerialLineTest : public FolderTest {};

TEST_F(SerialLineTest, TheBytesOfAnyValuePassUnchangedInBothDirections) {
  PseudoTerminal pair;
  SerialLine line({.path = pair.path()});
  std::string all(256, '\0');
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = static_cast<char>(i);
  }
  ASSERT_EQ(::write(pair.board(), all.data(), all.size()), 256);
  EXPECT_EQ(read_text(line, all.size()), all);

  line.write(wire_bytes(all));
  std::string heard(all.size(), '?');
  ASSERT_TRUE(hal::wait_readable(pair.board(), hal::monotonic_now_ns() + kLinePatience_ns));
  ASSERT_EQ(::read(pair.board(), heard.data(), heard.size()), 256);
  EXPECT_EQ(heard, all);
}

TEST_F(SerialLineTest, ARateThatTermiosHasNoConstantForIsSet) {
  const PseudoTerminal pair;
  const SerialLine line({.path = pair.path(), .baud = 250'000});
  struct termios2 settings{};
  ASSERT_EQ(::ioctl(pair.board(), TCGETS2, &settings), 0);
  EXPECT_EQ(settings.c_ospeed, 250'000U);
  EXPECT_EQ(settings.c_ispeed, 250'000U);
  EXPECT_EQ(settings.c_cflag & CSIZE, static_cast<tcflag_t>(CS8));
  EXPECT_EQ(settings.c_cflag & static_cast<tcflag_t>(PARENB | CSTOPB | CRTSCTS), 0U);
  EXPECT_EQ(settings.c_lflag & static_cast<tcflag_t>(ICANON | ECHO | ISIG), 0U);
  EXPECT_EQ(settings.c_iflag & static_cast<tcflag_t>(IXON | ICRNL), 0U);
}

TEST_F(SerialLineTest, BytesFromBeforeItWasOpenedAreDropped) {
  const PseudoTerminal pair;
  const int other = ::open(pair.path().c_str(), O_RDWR | O_NOCTTY);
  ASSERT_EQ(::write(pair.board(), "old\n", 4), 4);
  SerialLine line({.path = pair.path()});
  ASSERT_EQ(::write(pair.board(), "new", 3), 3);
  EXPECT_EQ(read_text(line, 3), "new");
  ::close(other);
}

TEST_F(SerialLineTest, ASilentLineGivesNothingAtTheDeadline) {
  const PseudoTerminal pair;
  SerialLine line({.path = pair.path()});
  std::array<std::byte, 8> room{};
  EXPECT_EQ(line.read(room, hal::monotonic_now_ns() + hal::kNsPerSecond / 100), 0U);
}

TEST_F(SerialLineTest, ALineThatIsHungUpIsLost) {
  PseudoTerminal pair;
  SerialLine line({.path = pair.path()});
  pair.hang_up();
  std::array<std::byte, 8> room{};
  EXPECT_THROW(line.read(room, hal::monotonic_now_ns() + kLinePatience_ns), UnreachableError);
  EXPECT_THROW(line.write(wire_bytes("x")), UnreachableError);
}

TEST_F(SerialLineTest, ASecondProgramIsToldWhichProgramHoldsTheLine) {
  const PseudoTerminal pair;
  std::array<int, 2> told{};
  std::array<int, 2> end{};
  ASSERT_EQ(::pipe(told.data()), 0);
  ASSERT_EQ(::pipe(end.data()), 0);
  const pid_t child = ::fork();
  if (child == 0) {
    const SerialLine line({.path = pair.path()});
    char byte = 'x';
    (void)!::write(told[1], &byte, 1);
    ::close(end[1]);
    (void)!::read(end[0], &byte, 1);
    ::_exit(0);
  }
  char byte = 0;
  ASSERT_EQ(::read(told[0], &byte, 1), 1);
  const std::string refusal = opening_refusal({.path = pair.path()});
  EXPECT_NE(refusal.find(pair.path()), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("(process " + std::to_string(child) + ") holds it"), std::string::npos)
      << refusal;
  ::close(end[1]);
  ::waitpid(child, nullptr, 0);
  EXPECT_EQ(opening_refusal({.path = pair.path()}), "");
  for (const int descriptor : {told[0], told[1], end[0]}) {
    ::close(descriptor);
  }
}

TEST_F(SerialLineTest, AMissingPortIsRefusedWithThoseThatThereAre) {
  const std::string refusal = opening_refusal({.path = file("ttyUSB7")});
  EXPECT_NE(refusal.find("ttyUSB7: there is no such port; "), std::string::npos) << refusal;
  std::filesystem::create_directory(file("by-id"));
  std::ofstream(file("by-id/usb-ST-Link-if02")) << "";
  EXPECT_EQ(port_words(file("by-id")), "there are " + file("by-id/usb-ST-Link-if02"));
  EXPECT_NE(port_words(file("none")).find("no USB serial port"), std::string::npos);
}

TEST_F(SerialLineTest, AFileThatIsNoPortIsRefused) {
  std::ofstream(file("notes.txt")) << "x";
  EXPECT_NE(opening_refusal({.path = file("notes.txt")}).find("no serial port"), std::string::npos);
}

TEST_F(SerialLineTest, APortOfAGroupIsRefusedWithTheCommandThatJoinsIt) {
  EXPECT_NE(serial_remedy({.path = "/dev/null"}, EACCES).find("sudo usermod -aG root $USER"),
            std::string::npos);
}

TEST_F(SerialLineTest, AnEmulatorsSocketIsALine) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  const std::string path = file("uart.sock");
  EXPECT_NE(opening_refusal({.path = path, .is_socket = true}).find("no emulator runs there"),
            std::string::npos);
  std::ranges::copy(path, std::begin(address.sun_path));
  const hal::FileDescriptor listening(::socket(AF_UNIX, SOCK_STREAM, 0));
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
  const auto* const general = reinterpret_cast<const sockaddr*>(&address);
  ASSERT_EQ(::bind(listening.get(), general, sizeof address), 0);
  ASSERT_EQ(::listen(listening.get(), 1), 0);
  SerialLine line({.path = path, .is_socket = true});
  hal::FileDescriptor board(::accept(listening.get(), nullptr, nullptr));
  line.write(wire_bytes("hello"));
  std::string heard(5, '?');
  ASSERT_EQ(::read(board.get(), heard.data(), heard.size()), 5);
  EXPECT_EQ(heard, "hello");
  board.reset();
  std::array<std::byte, 8> room{};
  EXPECT_THROW(line.read(room, hal::monotonic_now_ns() + kLinePatience_ns), UnreachableError);
  EXPECT_THROW(line.write(wire_bytes("x")), UnreachableError);
}

}  // namespace
}  // namespace tactus::host
