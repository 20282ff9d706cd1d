#include "tests/unit/host_tools/deploy/fake_board.h"

#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "tests/support/paths.h"

namespace tactus::testing {
namespace {

namespace fs = std::filesystem;

void write_board_file(const fs::path& file, const std::string& content) {
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << content;
}

std::string board_file(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

void in_shell(const std::string& command) {
  ASSERT_EQ(std::system((command + " >/dev/null").c_str()), 0) << command;
}

Tree tree_of(const fs::path& folder) {
  Tree tree;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const auto rights = static_cast<unsigned>(entry.status().permissions());
    tree[fs::relative(entry.path(), folder).string()] =
        std::to_string(rights) + " " + (entry.is_regular_file() ? board_file(entry.path()) : "");
  }
  return tree;
}

}  // namespace

FakeBoardTest::FakeBoardTest() : path_before_(std::getenv("PATH")) {
  for (const char* const folder :
       {"host_bin", "fake/bin", "fake/faults", "fake/root/etc", "fake/root/tmp",
        "fake/root/var/lib/dpkg/info", "fake/root/var/lib/dpkg/updates", "fake/root/run/tactus"}) {
    fs::create_directories(file(folder));
  }
  const std::string fake = in_repository("tests/unit/host_tools/deploy/fake_board.sh");
  fs::create_symlink(fake, file("host_bin/ssh"));
  for (const char* const program : {"sudo", "apt-get", "dpkg", "dpkg-query", "systemctl",
                                    "journalctl", "tactus", "sleep", "df", "sync"}) {
    fs::create_symlink(fake, file(std::string("fake/bin/") + program));
  }
  write_board_file(file("fake/root/usr/bin/other"), "a program of the board\n");
  write_board_file(file("fake/root/var/lib/dpkg/status"), "");
  write_board_file(file("fake/root/var/lib/dpkg/available"), "");
  write_board_file(file("fake/service"), "inactive\n");
  write_board_file(file("fake/restarts"), "0\n");
  write_board_file(file("fake/status"), "ok status tick=9 mode=ready faults=none scene=none\n");
  ::setenv("PATH", (file("host_bin") + ":" + path_before_).c_str(), 1);
  ::setenv("TACTUS_FAKE_BOARD", file("fake").c_str(), 1);
}

FakeBoardTest::~FakeBoardTest() {
  wait_for_the_end();
  ::setenv("PATH", path_before_.c_str(), 1);
  ::unsetenv("TACTUS_FAKE_BOARD");
}

void FakeBoardTest::make_packages(const std::string& version, const std::string& build,
                                  const std::string& architecture) const {
  const std::string folder = file("packages");
  fs::remove_all(folder);
  fs::create_directories(folder);
  const std::string wanted = architecture.empty() ? "$(dpkg --print-architecture)" : architecture;
  for (const std::string name : {"tactus", "tactusd"}) {
    const fs::path tree = file("tree_of_" + name);
    fs::remove_all(tree);
    write_board_file(tree / "usr/bin" / name, "#!/bin/sh\n# " + build + "\n");
    write_board_file(tree / "DEBIAN/control",
                     fmt::format("Package: {}\nVersion: {}\nArchitecture: @\n"
                                 "Maintainer: Ada <ada@example.org>\nInstalled-Size: 10\n"
                                 "Description: a fake\n",
                                 name, version));
    if (name == "tactusd") {
      write_board_file(tree / "etc/tactus/tactusd.env",
                       "# settings of " + build +
                           "\nTACTUSD_DEVICE=/etc/tactus/device.tactus\n"
                           "TACTUSD_SCENE=/etc/tactus/scene.tactus\n");
      write_board_file(tree / "DEBIAN/conffiles", "/etc/tactus/tactusd.env\n");
    }
    in_shell(fmt::format(
        "cd {} && sed -i \"s/@/{}/\" DEBIAN/control && find usr etc -type f 2>/dev/null | xargs "
        "md5sum >DEBIAN/md5sums && chmod -R go-w . && "
        "dpkg-deb -Zgzip -z1 --build . \"{}/{}_{}_{}.deb\"",
        tree.string(), wanted, folder, name, version, wanted));
  }
}

std::string FakeBoardTest::image(const std::string& name, const std::string& content) const {
  write_board_file(file(name), content);
  return file(name);
}

void FakeBoardTest::let_fail(const std::string& fault) const {
  write_board_file(file("fake/faults/" + fault), "");
}

void FakeBoardTest::mend(const std::string& fault) const {
  fs::remove(file("fake/faults/" + fault));
}

Outcome FakeBoardTest::deploy(const std::string& arguments) const {
  return run_program(folder(), "deploy ada@board --packages packages --timeout 3 " + arguments);
}

void FakeBoardTest::deploy_first() const {
  make_packages("0.1.0", "first");
  const Outcome outcome = deploy("--device " + image("arm.tactus", "arm one") + " --scene " +
                                 image("cup.tactus", "cup one"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  ASSERT_EQ(service(), "active\n");
}

std::string FakeBoardTest::on_board(const std::string& name) const {
  return board_file(file("fake/root/" + name));
}

Tree FakeBoardTest::board() const {
  Tree tree = tree_of(file("fake/root"));
  std::erase_if(tree, [](const auto& entry) {
    const std::string& name = entry.first;
    return name.starts_with("tmp") || name.ends_with("/lock") || name.ends_with("/lock-frontend") ||
           name.ends_with("/status-old") || name.starts_with("var/lib/dpkg/triggers");
  });
  return tree;
}

std::string FakeBoardTest::service() const {
  return board_file(file("fake/service"));
}

std::string FakeBoardTest::loaded() const {
  return board_file(file("fake/loaded"));
}

void FakeBoardTest::stop_service() const {
  write_board_file(file("fake/service"), "inactive\n");
}

std::string FakeBoardTest::calls() const {
  return board_file(file("fake/calls"));
}

Tree FakeBoardTest::left_over() const {
  return tree_of(file("fake/root/tmp"));
}

void FakeBoardTest::wait_for_the_end() const {
  const std::string lock = file("fake/root/var/lib/tactus-deploy/lock");
  if (fs::exists(lock)) {
    in_shell("flock '" + lock + "' true");
  }
}

}  // namespace tactus::testing
