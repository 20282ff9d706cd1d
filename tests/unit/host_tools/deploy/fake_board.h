// A board in a folder, with packages to bring there; fake_board.sh says what of it is real.
#pragma once

#include <map>
#include <string>

#include "tests/support/folder_test.h"
#include "tests/support/run_program.h"

namespace tactus::testing {

// The files below a folder by their names, with their rights and contents.
using Tree = std::map<std::string, std::string>;

class FakeBoardTest : public FolderTest {
 public:
  FakeBoardTest(const FakeBoardTest&) = delete;
  FakeBoardTest& operator=(const FakeBoardTest&) = delete;
  ~FakeBoardTest() override;

 protected:
  FakeBoardTest();

  // Makes the packages tactus and tactusd of the version in the folder `packages`; `build` is in
  // each of their programs.
  void make_packages(const std::string& version, const std::string& build,
                     const std::string& architecture = "") const;
  // Writes an image that is not one: the board's tactusd is faked.
  [[nodiscard]] std::string image(const std::string& name, const std::string& content) const;
  void let_fail(const std::string& fault) const;
  void mend(const std::string& fault) const;

  // Runs `tactus deploy ada@board` with more arguments.
  [[nodiscard]] Outcome deploy(const std::string& arguments = "") const;
  // Installs a first deployment: packages `first`, device and scene.
  void deploy_first() const;

  // Returns the board's file, empty if it is not there.
  [[nodiscard]] std::string on_board(const std::string& name) const;
  // Returns everything that a deployment may change on the board: programs, settings, images, the
  // records of dpkg, and what is kept for the next one.
  [[nodiscard]] Tree board() const;
  // Returns the state of the service: active, inactive or activating.
  [[nodiscard]] std::string service() const;
  // Returns the program and the images with which the service was started last.
  [[nodiscard]] std::string loaded() const;
  void stop_service() const;
  // Returns what was called on the board, a line each.
  [[nodiscard]] std::string calls() const;
  // Returns the names in the board's folder for temporary files.
  [[nodiscard]] Tree left_over() const;
  // Waits until no deployment runs on the board.
  void wait_for_the_end() const;

 private:
  std::string path_before_;
};

}  // namespace tactus::testing
