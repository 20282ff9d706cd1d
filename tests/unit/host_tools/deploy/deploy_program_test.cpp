// `tactus deploy` as a user runs it, to the board of fake_board.sh.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "host_tools/files/atomic_file.h"
#include "tests/support/paths.h"
#include "tests/unit/host_tools/deploy/fake_board.h"

namespace tactus::host {
namespace {

using testing::Outcome;
using testing::Tree;

class DeployProgram : public testing::FakeBoardTest {
 protected:
  // Deploys a second build over the first, which must fail and leave everything as it was.
  void expect_put_back(const std::string& build, const std::string& said,
                       const std::string& arguments = "") const {
    const Tree before = board();
    const std::string loaded_before = loaded();
    make_packages("0.1.0", build);
    const Outcome outcome = deploy(arguments);
    EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
    EXPECT_NE(outcome.output.find(said), std::string::npos) << outcome.output;
    EXPECT_NE(outcome.output.find("everything is as it was before"), std::string::npos)
        << outcome.output;
    EXPECT_EQ(board(), before);
    EXPECT_EQ(service(), "active\n");
    EXPECT_EQ(loaded(), loaded_before);
    EXPECT_TRUE(left_over().empty());
  }

  // Deploys, which must be refused before anything changes.
  void expect_refusal(const std::string& said, const std::string& arguments = "") const {
    const Tree before = board();
    const std::string state = service();
    const Outcome outcome = deploy(arguments);
    EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
    EXPECT_NE(outcome.output.find(said), std::string::npos) << outcome.output;
    Tree after = board();
    std::erase_if(after, [&](const auto& entry) {
      return entry.first == "var/lib/tactus-deploy" && !before.contains(entry.first);
    });
    EXPECT_EQ(after, before);
    EXPECT_EQ(service(), state);
    EXPECT_TRUE(left_over().empty());
  }
};

TEST_F(DeployProgram, InstallsPackagesAndImagesAndStartsTheService) {
  make_packages("0.1.0", "first");
  const Outcome outcome = deploy("--device " + image("arm.tactus", "arm one") + " --scene " +
                                 image("cup.tactus", "cup one"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(service(), "active\n");
  EXPECT_EQ(on_board("usr/bin/tactusd"), "#!/bin/sh\n# first\n");
  EXPECT_EQ(on_board("usr/bin/tactus"), "#!/bin/sh\n# first\n");
  EXPECT_EQ(on_board("etc/tactus/device.tactus"), "arm one");
  EXPECT_EQ(on_board("etc/tactus/scene.tactus"), "cup one");
  EXPECT_NE(calls().find("tactus doctor "), std::string::npos);
  EXPECT_TRUE(left_over().empty());
}

TEST_F(DeployProgram, BakesTheDeviceAndTheScene) {
  make_packages("0.1.0", "first");
  const std::string examples = testing::in_repository("host_tools/examples/");
  const Outcome outcome = deploy("--device " + examples + "devices/falcon.toml --scene " +
                                 examples + "primitives/scene.toml");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  ASSERT_EQ(testing::run_program(folder(), "bake " + examples + "devices/falcon.toml -o d.tactus")
                .exit_code,
            0);
  EXPECT_EQ(on_board("etc/tactus/device.tactus"), read_file(file("d.tactus")));
  EXPECT_FALSE(on_board("etc/tactus/scene.tactus").empty());
}

TEST_F(DeployProgram, WithoutAnImageInstallsThePackagesAndSaysWhatTheServiceWaitsFor) {
  make_packages("0.1.0", "first");
  const Outcome outcome = deploy();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("waits for the image of a device"), std::string::npos);
  EXPECT_EQ(service(), "inactive\n");
}

TEST_F(DeployProgram, TheSecondDeploymentKeepsTheImagesThatAreNotGiven) {
  deploy_first();
  make_packages("0.2.0", "second");
  const Outcome outcome = deploy("--scene " + image("cup.tactus", "cup two"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(on_board("usr/bin/tactusd"), "#!/bin/sh\n# second\n");
  EXPECT_EQ(on_board("etc/tactus/device.tactus"), "arm one");
  EXPECT_EQ(on_board("etc/tactus/scene.tactus"), "cup two");
  EXPECT_EQ(service(), "active\n");
  EXPECT_EQ(loaded(), "#!/bin/sh\n# second\narm onecup two");
}

TEST_F(DeployProgram, WaitsForAServiceWhoseFirstStartFails) {
  deploy_first();
  make_packages("0.2.0", "second");
  let_fail("starts_late");
  const Outcome outcome = deploy();
  ASSERT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_EQ(service(), "active\n");
  EXPECT_EQ(loaded(), "#!/bin/sh\n# second\narm onecup one");
}

TEST_F(DeployProgram, DryRunChangesNothing) {
  deploy_first();
  make_packages("0.2.0", "second");
  const Tree before = board();
  const std::string called = calls();
  const Outcome outcome = deploy("--dry-run --device " + image("arm.tactus", "arm two"));
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("would replace /etc/tactus/device.tactus\n"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(board(), before);
  EXPECT_EQ(calls().substr(called.size()).find("board.sh"), std::string::npos);
  EXPECT_TRUE(left_over().empty());
}

TEST_F(DeployProgram, NamesTheCommandThatMakesThePackages) {
  std::filesystem::create_directory(file("packages"));
  expect_refusal("toolchains/debian-packages.sh ");
}

TEST_F(DeployProgram, TakesNoPackagesForAnotherProcessor) {
  make_packages("0.1.0", "first", "s390x");
  expect_refusal("which the board takes; make them: toolchains/debian-packages.sh");
}

TEST_F(DeployProgram, WantsBothPackagesOfOneBuild) {
  make_packages("0.1.0", "first");
  for (const auto& entry : std::filesystem::directory_iterator(file("packages"))) {
    if (entry.path().filename().string().starts_with("tactus_")) {
      std::filesystem::remove(entry.path());
    }
  }
  expect_refusal("there is no tactus_0.1.0_");
}

TEST_F(DeployProgram, SaysThatTheBoardIsNotReached) {
  make_packages("0.1.0", "first");
  let_fail("unreachable");
  expect_refusal("ada@board: ssh does not reach it");
}

TEST_F(DeployProgram, SaysThatSshIsMissing) {
  make_packages("0.1.0", "first");
  ::setenv("PATH", file("fake/root").c_str(), 1);
  const Outcome outcome = testing::run_program(folder(), "deploy ada@board --packages packages");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("Debian: openssh-client"), std::string::npos) << outcome.output;
}

TEST_F(DeployProgram, TakesNoOptionOfSshForABoard) {
  const Outcome outcome = testing::run_program(folder(), "deploy -- -oProxyCommand=touch");
  EXPECT_EQ(outcome.exit_code, 2) << outcome.output;
  EXPECT_NE(outcome.output.find("write the board as for ssh"), std::string::npos) << outcome.output;
}

TEST_F(DeployProgram, RefusesWhileAHandMayFeelForces) {
  deploy_first();
  std::ofstream(file("fake/status")) << "ok status tick=9 mode=active faults=none scene=none\n";
  expect_refusal("a hand may feel the forces");
  EXPECT_EQ(deploy("--force").exit_code, 0);
}

TEST_F(DeployProgram, RefusesIfTheControllerDoesNotSayItsMode) {
  deploy_first();
  let_fail("no_reply");
  expect_refusal("does not say whether it is at rest");
}

TEST_F(DeployProgram, RefusesAnImageThatTheServiceDoesNotRead) {
  deploy_first();
  std::ofstream(file("fake/root/etc/tactus/tactusd.env"))
      << "TACTUSD_DEVICE=/etc/tactus/left.tactus\n";
  expect_refusal("write TACTUSD_DEVICE=/etc/tactus/device.tactus there",
                 "--device " + image("arm.tactus", "arm two"));
}

TEST_F(DeployProgram, RefusesWhereTheDiskHasNoRoom) {
  deploy_first();
  let_fail("no_room");
  expect_refusal("KiB free");
}

TEST_F(DeployProgram, RefusesPackagesThatItCouldNotPutBack) {
  deploy_first();
  std::filesystem::remove_all(file("fake/root/var/lib/tactus-deploy/kept"));
  expect_refusal("the board has tactus from elsewhere");
  EXPECT_EQ(deploy("--no-rollback").exit_code, 0);
}

TEST_F(DeployProgram, AFailedFirstDeploymentLeavesNothing) {
  make_packages("0.1.0", "broken");
  const Tree before = board();
  const Outcome outcome = deploy("--device " + image("arm.tactus", "arm one"));
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  Tree after = board();
  std::erase_if(after, [&](const auto& entry) {
    const bool is_new = !before.contains(entry.first);
    return entry.first.starts_with("var/lib/tactus-deploy") ||
           (is_new && entry.first.starts_with("var/lib/dpkg/info"));
  });
  EXPECT_EQ(after, before);
  EXPECT_EQ(on_board("usr/bin/tactusd"), "");
}

TEST_F(DeployProgram, PutsBackIfAptLacksALibrary) {
  deploy_first();
  let_fail("apt_finds_no_library");
  expect_put_back("second", "bookworm-backports");
}

TEST_F(DeployProgram, PutsBackIfTheDiskIsFullAfterOnePackage) {
  deploy_first();
  let_fail("apt_fills_the_disk");
  expect_put_back("second", "No space left on device");
}

TEST_F(DeployProgram, PutsBackAPackageThatIsHalfInstalled) {
  deploy_first();
  let_fail("postinst_fails");
  expect_put_back("second", "apt cannot install the packages");
}

TEST_F(DeployProgram, PutsBackIfAnImageCannotBeWritten) {
  deploy_first();
  let_fail("images_fill_the_disk");
  expect_put_back("second", "cannot write", "--scene " + image("cup.tactus", "cup two"));
}

TEST_F(DeployProgram, PutsBackIfTheServiceDoesNotBecomeActive) {
  deploy_first();
  expect_put_back("broken", "tactusd did not become active within 3 s");
}

TEST_F(DeployProgram, PutsBackIfTheServiceCrashesAgainAndAgain) {
  deploy_first();
  expect_put_back("crashing", "tactusd did not become active within 3 s");
}

TEST_F(DeployProgram, PutsBackAnImageThatTheServiceDoesNotTake) {
  deploy_first();
  expect_put_back("second", "its last words are above",
                  "--device " + image("arm.tactus", "broken"));
}

TEST_F(DeployProgram, PutsBackIfTheDoctorFindsSomethingToMend) {
  deploy_first();
  const std::string device = "--device " + image("arm.tactus", "unwell");
  expect_put_back("second", "the doctor found something to mend", device);
  EXPECT_EQ(deploy(device + " --ignore-doctor").exit_code, 0);
  EXPECT_EQ(on_board("etc/tactus/device.tactus"), "unwell");
}

TEST_F(DeployProgram, SettingsThatWereChangedOnTheBoardStay) {
  deploy_first();
  const std::string settings = "# mine\nTACTUSD_OPTIONS=--cpu 3\n";
  std::ofstream(file("fake/root/etc/tactus/tactusd.env")) << settings;
  expect_put_back("broken", "its last words are above");
  make_packages("0.2.0", "second");
  EXPECT_EQ(deploy().exit_code, 0);
  EXPECT_EQ(on_board("etc/tactus/tactusd.env"), settings);
}

TEST_F(DeployProgram, AFailureLeavesAStoppedServiceStopped) {
  deploy_first();
  stop_service();
  make_packages("0.1.0", "broken");
  EXPECT_EQ(deploy().exit_code, 1);
  EXPECT_EQ(service(), "inactive\n");
}

TEST_F(DeployProgram, SaysSoIfNotEverythingCanBePutBack) {
  deploy_first();
  make_packages("0.1.0", "second");
  let_fail("nothing_starts");
  const Outcome outcome = deploy();
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_NE(outcome.output.find("tactusd does not start again"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(on_board("usr/bin/tactusd"), "#!/bin/sh\n# first\n");
}

TEST_F(DeployProgram, LeavesTheMotorsOffIfThePackagesCannotBePutBack) {
  deploy_first();
  make_packages("0.1.0", "broken");
  let_fail("dpkg_cannot_write");
  const Outcome outcome = deploy("--device " + image("arm.tactus", "arm two"));
  EXPECT_EQ(outcome.exit_code, 3) << outcome.output;
  EXPECT_NE(outcome.output.find("tactusd is not as it was before"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(on_board("etc/tactus/device.tactus"), "arm one");
  EXPECT_EQ(service(), "inactive\n");
}

TEST_F(DeployProgram, AFailureLeavesAServiceThatTriesAgainTrying) {
  deploy_first();
  std::ofstream(file("fake/root/etc/tactus/device.tactus")) << "broken";
  std::ofstream(file("fake/service")) << "activating\n";
  make_packages("0.2.0", "second");
  EXPECT_EQ(deploy().exit_code, 1);
  EXPECT_EQ(on_board("usr/bin/tactusd"), "#!/bin/sh\n# first\n");
  EXPECT_EQ(service(), "activating\n");
}

TEST_F(DeployProgram, AConnectionThatIsCutWhileCopyingChangesNothing) {
  deploy_first();
  let_fail("cut_while_copying");
  expect_refusal("the files did not arrive whole");
}

TEST_F(DeployProgram, GoesOnAfterACutAndShowsTheRest) {
  deploy_first();
  make_packages("0.2.0", "second");
  let_fail("cut_at_start");
  const Outcome outcome = deploy();
  EXPECT_EQ(outcome.exit_code, 0) << outcome.output;
  EXPECT_NE(outcome.output.find("connecting again"), std::string::npos) << outcome.output;
  EXPECT_NE(outcome.output.find("  deployed\n"), std::string::npos) << outcome.output;
  EXPECT_EQ(on_board("usr/bin/tactusd"), "#!/bin/sh\n# second\n");
}

TEST_F(DeployProgram, PutsBackByItselfWhenTheConnectionIsGoneForGood) {
  deploy_first();
  const Tree before = board();
  make_packages("0.2.0", "broken");
  let_fail("cut_at_start");
  let_fail("cut_for_good");
  const Outcome outcome = deploy();
  EXPECT_EQ(outcome.exit_code, 4) << outcome.output;
  EXPECT_NE(outcome.output.find("the board goes on by itself, and puts everything back"),
            std::string::npos)
      << outcome.output;
  wait_for_the_end();
  EXPECT_EQ(board(), before);
  EXPECT_EQ(service(), "active\n");
}

TEST_F(DeployProgram, TheNextDeploymentPutsBackWhatALossOfPowerLeft) {
  deploy_first();
  make_packages("0.2.0", "second");
  let_fail("apt_is_killed");
  EXPECT_EQ(deploy().exit_code, 3);
  mend("apt_is_killed");
  make_packages("0.3.0", "broken");
  const Outcome outcome = deploy();
  EXPECT_EQ(outcome.exit_code, 1) << outcome.output;
  EXPECT_NE(outcome.output.find("the deployment before this one was cut off"), std::string::npos)
      << outcome.output;
  EXPECT_EQ(on_board("usr/bin/tactusd"), "#!/bin/sh\n# first\n");
  EXPECT_EQ(service(), "active\n");
}

TEST_F(DeployProgram, OfTwoAtOnceOneWaitsForAnotherTime) {
  deploy_first();
  make_packages("0.2.0", "second");
  const std::string lock = file("fake/root/var/lib/tactus-deploy/lock");
  ASSERT_EQ(std::system(("flock '" + lock + "' sleep 2 & sleep 0.2").c_str()), 0);
  expect_refusal("another deployment to this board is going on");
  wait_for_the_end();
  EXPECT_EQ(deploy().exit_code, 0);
}

}  // namespace
}  // namespace tactus::host
