// A board that ssh reaches.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace tactus::host {

// The address of a board, and how ssh reaches it.
struct BoardAddress {
  // The target of ssh: user@board, or a name of the user's ssh configuration.
  std::string target;
  // A private key; empty: those that ssh tries.
  std::string identity;
  // Options of ssh's -o, like "Port=2222".
  std::vector<std::string> options;
};

using OnLine = std::function<void(std::string_view)>;

class Board {
 public:
  // The exit code of ssh itself: the board was not reached, or the connection was lost.
  static constexpr int kLost = 255;

  // Throws InputError for a target that ssh would take for an option.
  explicit Board(const BoardAddress& address);

  // Runs a command of the board's shell and hands over the lines of its output. Returns its exit
  // code, or kLost.
  [[nodiscard]] int run(const std::string& command, const OnLine& line) const;

  // Sends the files of a folder to the input of such a command, as tar packs them.
  [[nodiscard]] int send(const std::filesystem::path& folder, const std::string& command,
                         const OnLine& line) const;

  [[nodiscard]] const std::string& target() const { return target_; }

 private:
  [[nodiscard]] std::string ssh(const std::string& command) const;

  std::string target_;
  // The beginning of every command, quoted for a shell.
  std::string ssh_;
};

}  // namespace tactus::host
