// Does the same work on many things, on all processors.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace tactus::host {

// Calls work(worker, i) for every i below `count`; `worker` is what make_worker() returned in that
// thread. Which thread takes which i is not defined. `threads` = 0 takes one a processor. Throws
// the first exception of a call, after all threads have ended; no new work is begun after it.
template <class MakeWorker, class Work>
void for_all(std::size_t count, unsigned threads, const MakeWorker& make_worker, const Work& work) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto take = [&] {
    try {
      auto worker = make_worker();
      for (std::size_t i = next++; i < count; i = next++) {
        work(worker, i);
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      failure = failure ? failure : std::current_exception();
      next = count;
    }
  };
  {
    const unsigned wanted = threads > 0 ? threads : std::thread::hardware_concurrency();
    std::vector<std::jthread> crew;
    for (unsigned i = 0; i < std::clamp<unsigned>(wanted, 1, 256) && i < count; ++i) {
      crew.emplace_back(take);
    }
  }
  if (failure) {
    std::rethrow_exception(failure);
  }
}

}  // namespace tactus::host
