// A thread that performs a viewer's jobs, one at a time, so that the window never waits for a picture, a pipeline or a
// scene.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>

#include "view/job.h"

namespace lamp::app {

class Worker {
 public:
  /// `done`: called from the thread after each job.
  Worker(Stage& stage, std::function<void()> done);
  /// Waits for the job that is under way.
  ~Worker();
  Worker(const Worker&) = delete;
  Worker& operator=(const Worker&) = delete;

  /// There is none under way.
  void begin(Job job);
  /// What was done since the last call.
  [[nodiscard]] std::optional<Done> take();
  [[nodiscard]] bool busy();

 private:
  void run();

  Stage& stage_;
  std::function<void()> tell_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<Job> job_;
  std::optional<Done> done_;
  std::exception_ptr failure_;  ///< what is no Error ends the program, from the window's thread
  bool works_ = false;
  bool ends_ = false;
  std::thread thread_;  ///< the last member: it uses the others
};

}  // namespace lamp::app
