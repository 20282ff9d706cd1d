#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "host_tools/benchmark/jitter.h"
#include "host_tools/files/private_folder.h"
#include "host_tools/input_error.h"
#include "host_tools/programs/external_program.h"

namespace tactus::host {

namespace {

// Refuses output that this version does not understand.
[[noreturn]] void not_cyclictests(const char* what) {
  throw InputError(fmt::format("cyclictest's answer is not known to this version: {}", what));
}

// cyclictest names its bins by their lower edge in us, and leaves empty ones out.
void read_bins(const nlohmann::json& histogram, Jitter& jitter) {
  std::uint64_t binned = 0;
  for (const auto& [edge_us, count] : histogram.items()) {
    const std::size_t bin = std::strtoul(edge_us.c_str(), nullptr, 10);
    if (bin >= kJitterBins) {
      not_cyclictests("a bin beyond the last");
    }
    jitter.bins[bin] = count.get<std::uint64_t>();
    binned += jitter.bins[bin];
  }
  jitter.overflow = jitter.count - std::min(binned, jitter.count);
}

}  // namespace

Jitter read_cyclictest(std::string_view text) {
  Jitter jitter;
  try {
    const auto json = nlohmann::json::parse(text);
    const auto& thread = json.at("thread").at("0");
    jitter.count = thread.at("cycles").get<std::uint64_t>();
    jitter.min_us = thread.at("min").get<double>();
    jitter.mean_us = thread.at("avg").get<double>();
    jitter.max_us = thread.at("max").get<double>();
    read_bins(thread.at("histogram"), jitter);
  } catch (const nlohmann::json::exception& error) {
    not_cyclictests(error.what());
  }
  return jitter;
}

std::optional<Jitter> measure_cyclictest(const JitterPlan& plan, bool real_time) {
  if (!command_succeeds("PATH=\"$PATH:/usr/sbin:/sbin\" command -v cyclictest")) {
    return std::nullopt;
  }
  const PrivateFolder folder;
  const std::filesystem::path file = folder.path() / "cyclictest.json";
  const std::string command = fmt::format(
      "PATH=\"$PATH:/usr/sbin:/sbin\" cyclictest --quiet --threads=1 {} {} --interval={:.0f} "
      "--loops={:.0f} --histogram={} --json={}",
      real_time ? fmt::format("--mlockall --priority={}", plan.priority) : "--policy=other",
      plan.cpu ? fmt::format("--affinity={}", *plan.cpu) : "", 1e6 / plan.rate_hz,
      plan.seconds * plan.rate_hz, kJitterBins, shell_quoted(file));
  if (!command_succeeds(command)) {
    throw InputError("cyclictest failed; this shows why: " + command);
  }
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return read_cyclictest(text.str());
}

}  // namespace tactus::host
