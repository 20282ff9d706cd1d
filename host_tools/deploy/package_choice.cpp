#include "host_tools/deploy/package_choice.h"

#include <fmt/format.h>

#include <optional>
#include <system_error>

#include "host_tools/input_error.h"

namespace tactus::host {
namespace {

constexpr std::string_view kDaemonPrefix = "tactusd_";

// Returns the newest package of the daemon in a folder; nothing if there is none.
std::optional<std::filesystem::path> newest_daemon(const std::filesystem::path& folder,
                                                   std::string_view ending) {
  std::optional<std::filesystem::path> newest;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
    const std::string name = entry.path().filename().string();
    if (name.starts_with(kDaemonPrefix) && name.ends_with(ending) &&
        (!newest || entry.last_write_time() > std::filesystem::last_write_time(*newest))) {
      newest = entry.path();
    }
  }
  return newest;
}

}  // namespace

BoardPackages choose_packages(const std::filesystem::path& folder, std::string_view architecture) {
  const std::string ending = fmt::format("_{}.deb", architecture);
  const std::string remedy =
      fmt::format("make them: toolchains/debian-packages.sh {}; or name their folder by --packages",
                  architecture);
  for (const std::filesystem::path& place : {folder / architecture, folder}) {
    if (const auto daemon = newest_daemon(place, ending)) {
      const std::string rest = daemon->filename().string().substr(kDaemonPrefix.size());
      const std::filesystem::path program = place / ("tactus_" + rest);
      if (!std::filesystem::exists(program)) {
        throw InputError(fmt::format("{}: there is no {} beside it; {}", daemon->string(),
                                     program.filename().string(), remedy));
      }
      return {.tactus = program, .tactusd = *daemon};
    }
  }
  throw InputError(fmt::format("{}: has no tactusd_*{}, which the board takes; {}", folder.string(),
                               ending, remedy));
}

}  // namespace tactus::host
