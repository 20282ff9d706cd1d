// Sends a signal to one thread of a process, which `kill` cannot, and prints when on
// CLOCK_MONOTONIC, in nanoseconds.
//   signal_thread PROCESS THREAD_NAME SIGNAL_NUMBER
#include <dirent.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hal/linux/system.h"

namespace {

// 0: there is none.
long thread_of(const char* process, const char* name) {
  std::array<char, 300> path{};
  std::snprintf(path.data(), path.size(), "/proc/%s/task", process);
  DIR* const threads = opendir(path.data());
  long found = 0;
  while (const dirent* entry = threads == nullptr ? nullptr : readdir(threads)) {
    std::snprintf(path.data(), path.size(), "/proc/%s/task/%s/comm", process, entry->d_name);
    std::FILE* const file = std::fopen(path.data(), "r");
    std::array<char, 32> comm{};
    if (file != nullptr && std::fgets(comm.data(), comm.size(), file) != nullptr) {
      comm[std::strcspn(comm.data(), "\n")] = '\0';
      found = std::strcmp(comm.data(), name) == 0 ? std::atol(entry->d_name) : found;
    }
    if (file != nullptr) {
      std::fclose(file);
    }
  }
  if (threads != nullptr) {
    closedir(threads);
  }
  return found;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) {
    std::fprintf(stderr, "usage: signal_thread PROCESS THREAD_NAME SIGNAL_NUMBER\n");
    return 2;
  }
  const long thread = thread_of(argv[1], argv[2]);
  const auto now_ns = tactus::hal::monotonic_now_ns();
  if (thread == 0 || syscall(SYS_tgkill, std::atol(argv[1]), thread, std::atol(argv[3])) != 0) {
    std::fprintf(stderr, "signal_thread: process %s has no thread '%s'\n", argv[1], argv[2]);
    return 1;
  }
  std::printf("%" PRId64 "\n", now_ns);
  return 0;
}
