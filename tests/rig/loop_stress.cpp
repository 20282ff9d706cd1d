// Keeps a machine busy beside a real-time loop, until it is killed: one process computes without
// pause; others, in bursts, fork, map and fault in memory, pass messages through pipes and write to
// files, which are the kernel's longest ways. All at ordinary priority.
//   loop_stress [MILLISECONDS_BETWEEN_BURSTS]
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

constexpr std::size_t kMapped_bytes = std::size_t{2} << 20;
constexpr std::size_t kPage_bytes = 4096;

void pause_ms(long milliseconds) {
  const timespec pause{.tv_sec = milliseconds / 1000, .tv_nsec = milliseconds % 1000 * 1'000'000};
  nanosleep(&pause, nullptr);
}

[[noreturn]] void compute() {
  std::array<std::uint64_t, 4096> table{};
  for (std::uint64_t state = 88172645463325252U;;) {
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    table[state % table.size()] += state;
    asm volatile("" ::"r"(table.data()) : "memory");
  }
}

void fork_some() {
  for (int i = 0; i < 4; ++i) {
    const pid_t child = fork();
    if (child == 0) {
      _exit(0);
    }
    waitpid(child, nullptr, 0);
  }
}

void fault_in_memory() {
  void* mapped =
      mmap(nullptr, kMapped_bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) {
    return;
  }
  auto* bytes = static_cast<volatile char*>(mapped);
  for (std::size_t i = 0; i < kMapped_bytes; i += kPage_bytes) {
    bytes[i] = 1;
  }
  munmap(mapped, kMapped_bytes);
}

void write_a_file() {
  static constexpr std::array<char, 65536> kBlock{};
  const int file = open("/tmp/loop_stress", O_WRONLY | O_CREAT | O_TRUNC, 0600);
  for (int i = 0; i < 16 && write(file, kBlock.data(), kBlock.size()) > 0; ++i) {
  }
  close(file);
  unlink("/tmp/loop_stress");
}

// Two processes and two pipes: a byte goes to and fro.
class Messages {
 public:
  Messages() {
    if (pipe(there_.data()) != 0 || pipe(back_.data()) != 0) {
      std::exit(1);
    }
    if (fork() == 0) {
      for (char byte = 0; read(there_[0], &byte, 1) == 1 && write(back_[1], &byte, 1) == 1;) {
      }
      _exit(0);
    }
  }
  void pass_some() const {
    char byte = 0;
    for (int i = 0; i < 200; ++i) {
      if (write(there_[1], &byte, 1) != 1 || read(back_[0], &byte, 1) != 1) {
        std::exit(1);
      }
    }
  }

 private:
  std::array<int, 2> there_{};
  std::array<int, 2> back_{};
};

template <class Burst>
void in_bursts(long pause, Burst burst) {
  if (fork() == 0) {
    for (;;) {
      burst();
      pause_ms(pause);
    }
  }
}

}  // namespace

int main(int argc, char** argv) {
  const long pause = argc > 1 ? std::atol(argv[1]) : 20;
  setpgid(0, 0);
  in_bursts(pause, fork_some);
  in_bursts(pause, fault_in_memory);
  in_bursts(pause, write_a_file);
  if (fork() == 0) {
    const Messages messages;
    for (;;) {
      messages.pass_some();
      pause_ms(pause);
    }
  }
  compute();
}
