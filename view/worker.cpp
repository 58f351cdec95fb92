// A slot for a job, a slot for what came of it.
// SPDX-License-Identifier: Apache-2.0
#include "view/worker.h"

#include <utility>

namespace lamp::app {

Worker::Worker(Stage& stage, std::function<void()> done)
    : stage_(stage), tell_(std::move(done)), thread_([this] { run(); }) {}

Worker::~Worker() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Worker::begin(Job job) {
  {
    const std::lock_guard lock(mutex_);
    job_ = std::move(job);
    works_ = true;
  }
  changed_.notify_one();
}

std::optional<Done> Worker::take() {
  const std::lock_guard lock(mutex_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
  return std::exchange(done_, std::nullopt);
}

bool Worker::busy() {
  const std::lock_guard lock(mutex_);
  return works_;
}

void Worker::run() {
  std::unique_lock lock(mutex_);
  while (true) {
    changed_.wait(lock, [&] { return ends_ || job_.has_value(); });
    if (ends_) return;
    Job job = std::move(*job_);
    job_.reset();
    lock.unlock();
    std::optional<Done> done;
    std::exception_ptr failure;
    try {
      done = perform(stage_, std::move(job));
    } catch (...) {
      failure = std::current_exception();
    }
    lock.lock();
    done_ = std::move(done);
    failure_ = failure;
    works_ = false;
    tell_();
  }
}

}  // namespace lamp::app
