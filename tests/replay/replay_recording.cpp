// replay_recording RUN.mcap: `tactus replay` without what only the host has, so that it runs on a
// board's processor too. Ends with 0 if every hash is equal, 1 if one differs, 2 if it could not.
#include <cstdio>

#include "host_tools/input_error.h"
#include "host_tools/replay/replay.h"

namespace {

int run(const char* file) {
  tactus::host::RecordedRun recorded(file, {});
  const tactus::host::ReplayResult result = tactus::host::replay(recorded);
  std::printf("%llu ticks: every hash equal\n", static_cast<unsigned long long>(result.ticks));
  if (const auto& difference = result.difference) {
    std::printf("tick %llu differs: %s was %s and is now %s\n",
                static_cast<unsigned long long>(difference->tick), difference->field.c_str(),
                difference->recorded.c_str(), difference->replayed.c_str());
  }
  return result.difference ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: replay_recording RUN.mcap\n", stderr);
    return 2;
  }
  try {
    return run(argv[1]);
  } catch (const tactus::host::InputError& error) {
    std::fprintf(stderr, "replay_recording: %s\n", error.what());
    return 2;
  }
}
