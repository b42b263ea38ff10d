// SPDX-License-Identifier: MIT
#pragma once

#include <semaphore>
#include <thread>

namespace slamscope::slam {

/// A second thread that waits for work, so that sharing a millisecond's work costs microseconds and
/// allocates nothing.
class HelperThread {
 public:
  HelperThread() : thread_([this] { serve(); }) {}
  ~HelperThread() {
    work_ = nullptr;
    start_.release();
  }
  HelperThread(const HelperThread&) = delete;
  HelperThread& operator=(const HelperThread&) = delete;

  /// Runs `mine` here and `theirs` on the helper; returns when both are done. Neither may throw.
  template <typename Mine, typename Theirs>
  void share(const Mine& mine, const Theirs& theirs) {
    argument_ = &theirs;
    work_ = [](const void* argument) { (*static_cast<const Theirs*>(argument))(); };
    start_.release();
    mine();
    done_.acquire();
  }

 private:
  void serve() {
    for (start_.acquire(); work_ != nullptr; start_.acquire()) {
      work_(argument_);
      done_.release();
    }
  }

  void (*work_)(const void*) = nullptr;
  const void* argument_ = nullptr;
  std::binary_semaphore start_{0};
  std::binary_semaphore done_{0};
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace slamscope::slam
