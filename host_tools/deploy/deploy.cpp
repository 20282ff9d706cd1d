#include "host_tools/deploy/deploy.h"

#include <fmt/format.h>

#include <chrono>
#include <span>
#include <thread>

#include "host_tools/deploy/board.sh.h"
#include "host_tools/deploy/board_state.sh.h"
#include "host_tools/deploy/package_choice.h"
#include "host_tools/files/atomic_file.h"
#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"

namespace tactus::host {
namespace {

// The folder on the board is new, private, and gone again if the files did not arrive as they were
// sent.
constexpr const char* kReceive =
    "umask 077; folder=$(mktemp -d -t tactus-deploy.XXXXXX) || exit 1; "
    "if tar -C \"$folder\" -xf - && cd \"$folder\" && sha256sum --quiet -c SHA256SUMS; "
    "then echo \"folder $folder\"; else rm -rf \"$folder\"; exit 1; fi";
// The shell's exit code if there is no ssh here.
constexpr int kNoSsh = 127;
// Ends with kMayNotBecomeRoot if the user is not root and may not sudo.
constexpr int kMayNotBecomeRoot = 11;
constexpr const char* kProbe =
    "dpkg --print-architecture || exit 10; [ \"$(id -u)\" = 0 ] || sudo -n true || exit 11";
constexpr std::string_view kFolderLine = "folder ";

void write_script(const std::filesystem::path& file, std::string_view text) {
  write_file_atomically(file, std::as_bytes(std::span(text)));
}

// Returns the architecture that the board's dpkg names. Throws InputError.
std::string architecture_of(const Board& board) {
  std::string architecture;
  const int code =
      board.run(kProbe, [&](std::string_view line) { architecture = std::string(line); });
  switch (code) {
    case 0:
      return architecture;
    case Board::kLost:
      throw InputError(fmt::format("{}: ssh does not reach it; try: ssh {} true", board.target(),
                                   board.target()));
    case kNoSsh:
      throw InputError("ssh is missing here; install it (Debian: openssh-client)");
    case kMayNotBecomeRoot:
      throw InputError(fmt::format(
          "{}: this user may not become root without a password; log in as root, or allow sudo",
          board.target()));
    default:
      throw InputError(
          fmt::format("{}: has no dpkg; boards run Debian or what is built on it", board.target()));
  }
}

// Puts packages, scripts and their sums beside the images.
void pack(const BoardPackages& packages, const std::filesystem::path& folder) {
  std::error_code failure;
  std::filesystem::copy_file(packages.tactus, folder / "tactus.deb", failure);
  if (!failure) {
    std::filesystem::copy_file(packages.tactusd, folder / "tactusd.deb", failure);
  }
  if (failure) {
    throw InputError(
        fmt::format("{}: cannot copy the packages there: {}", folder.string(), failure.message()));
  }
  write_script(folder / "board.sh", kBoardScript);
  write_script(folder / "board_state.sh", kBoardStateScript);
  if (!command_succeeds("cd " + shell_quoted(folder) + " && sha256sum *.* >SHA256SUMS")) {
    throw InputError(fmt::format("{}: sha256sum failed", folder.string()));
  }
}

// Copies the folder to the board and returns its name there. Throws InputError.
std::string copy_to(const Board& board, const std::filesystem::path& folder) {
  std::string there;
  const int code = board.send(folder, kReceive, [&](std::string_view line) {
    if (line.starts_with(kFolderLine)) {
      there = std::string(line.substr(kFolderLine.size()));
    }
  });
  if (code != 0 || there.empty()) {
    throw InputError(fmt::format(
        "{}: the files did not arrive whole, and nothing was changed; {}", board.target(),
        code == Board::kLost ? "the connection was lost" : "is the board's disk full?"));
  }
  return there;
}

std::string options_of(const DeployOptions& options) {
  return fmt::format("{}{}{} --timeout {}", options.force ? " --force" : "",
                     options.ignore_doctor ? " --ignore-doctor" : "",
                     options.no_rollback ? " --no-rollback" : "", options.timeout_s);
}

// Runs the script on the board, which does not need the connection, and shows its progress. A lost
// connection is made anew for as long as the service may take.
int run_script(const Board& board, const DeployOptions& options, const std::string& there,
               const OnLine& say) {
  constexpr std::chrono::seconds kOnceMore(1);
  const std::string script = "sh " + shell_quoted(there) + "/board.sh ";
  std::size_t lines = 0;
  const OnLine show = [&](std::string_view line) {
    ++lines;
    say(fmt::format("  {}", line));
  };
  int code = board.run(script + "start" + options_of(options), show);
  for (unsigned tries = 0; code == Board::kLost && tries < options.timeout_s; ++tries) {
    if (tries == 0) {
      say("the connection was lost; the board goes on by itself: connecting again");
    }
    std::this_thread::sleep_for(kOnceMore);
    code = board.run(fmt::format("{}show {}", script, lines + 1), show);
  }
  return code;
}

DeployOutcome outcome_of(int code) {
  const bool is_known = code >= static_cast<int>(DeployOutcome::deployed) &&
                        code <= static_cast<int>(DeployOutcome::broken);
  return is_known ? static_cast<DeployOutcome>(code) : DeployOutcome::unknown;
}

void say_dry_run(const BoardPackages& packages, const std::filesystem::path& images,
                 const OnLine& say) {
  std::string files = "tactus.deb, tactusd.deb";
  std::string installed;
  for (const char* const image : {"device.tactus", "scene.tactus"}) {
    if (std::filesystem::exists(images / image)) {
      files += fmt::format(", {}", image);
      installed += fmt::format(" /etc/tactus/{}", image);
    }
  }
  say(fmt::format("would copy {} and {} into a new folder of the board, as {}, with their sums",
                  packages.tactus.string(), packages.tactusd.string(), files));
  say("would refuse, before anything changes, if tactusd is active or homing, or could not be put "
      "back");
  say("would stop tactusd and install both packages by apt");
  if (!installed.empty()) {
    say(fmt::format("would replace{}", installed));
  }
  say("would start tactusd, wait until it is active, and run tactus doctor");
  say("would put everything back if a step fails");
}

}  // namespace

DeployOutcome deploy(const DeployOptions& options, const std::filesystem::path& images,
                     const OnLine& say) {
  const Board board(options.board);
  say(fmt::format("==> 1/4 Ask {} what it is", board.target()));
  const std::string architecture = architecture_of(board);
  const BoardPackages packages = choose_packages(options.packages, architecture);
  say(fmt::format("  {}: {}", architecture, packages.tactusd.string()));
  if (options.dry_run) {
    say_dry_run(packages, images, say);
    return DeployOutcome::deployed;
  }
  say("==> 2/4 Copy packages and images");
  pack(packages, images);
  const std::string there = copy_to(board, images);
  say("==> 3/4 Install, start, and wait until the service is healthy");
  const DeployOutcome outcome = outcome_of(run_script(board, options, there, say));
  if (outcome == DeployOutcome::unknown) {
    say(
        fmt::format("the connection is lost; the board goes on by itself, and puts everything back "
                    "if a step fails. To see how it ended: ssh {} cat {}/log",
                    board.target(), there));
    return outcome;
  }
  say("==> 4/4 Clear up");
  static_cast<void>(board.run("rm -rf " + shell_quoted(there), [](std::string_view) {}));
  return outcome;
}

}  // namespace tactus::host
