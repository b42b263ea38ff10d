// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace slamscope::slam {

/// Calls work(0) … work(count − 1), each once, on `threads` threads (0: one per core). Returns when
/// all are done. The first exception ends it and is thrown on.
template <typename Work>
void parallelFor(int count, unsigned threads, Work work) {
  if (threads == 0) threads = std::max(1U, std::thread::hardware_concurrency());
  std::atomic<int> next{0};
  std::mutex mutex;
  std::exception_ptr thrown;
  const auto serve = [&] {
    for (int k = next++; k < count; k = next++) {
      try {
        work(k);
      } catch (...) {
        const std::lock_guard lock(mutex);
        if (!thrown) thrown = std::current_exception();
        next = count;
      }
    }
  };
  {
    std::vector<std::jthread> crew;
    for (unsigned t = 1; t < threads; ++t) crew.emplace_back(serve);
    serve();
  }
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace slamscope::slam
