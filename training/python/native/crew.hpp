// SPDX-License-Identifier: Apache-2.0
// Threads that do one job together, again and again: a job's parts 0 to size - 1, each by its own thread, the first by
// the caller's. A job begins and ends within a microsecond where it was soon after another: who waits keeps a core busy for
// 100 us before it sleeps.
//
// A process that was forked off has no threads of its parent's: `run` there throws std::runtime_error. A crew of one has
// none at all, and runs anywhere. Where the system gives fewer threads, the constructor throws std::runtime_error.
#pragma once

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace striker::training {

class Crew {
 public:
  explicit Crew(int size) : size_(size) {
    try {
      for (int part = 1; part < size; ++part) {
        threads_->emplace_back([this, part] { work(part); });
      }
    } catch (const std::exception&) {
      const std::size_t given = threads_->size() + 1;
      end();
      throw std::runtime_error("threads " + std::to_string(size) + ": the system gives " +
                               std::to_string(given) + " now; ask for fewer");
    }
  }
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew() {
    if (getpid() != home_) {
      // They are not in this process, where nothing can be said to them: what they were is left alone.
      static_cast<void>(threads_.release());
      return;
    }
    end();
  }

  [[nodiscard]] int size() const { return size_; }

  // `job` throws nothing.
  void run(const std::function<void(int part)>& job) {
    if (size_ == 1) {
      job(0);
      return;
    }
    if (getpid() != home_) {
      throw std::runtime_error(
          "the threads of this environment are in the process that made it: make one in each process");
    }
    job_ = &job;
    at_work_.store(size_ - 1, std::memory_order_relaxed);
    begin();
    job(0);
    while (const int left = at_work_.load(std::memory_order_acquire)) {
      wait_while(at_work_, left);
    }
  }

 private:
  void begin() {
    jobs_begun_.fetch_add(1, std::memory_order_release);
    jobs_begun_.notify_all();
  }

  void end() {
    job_ = nullptr;
    begin();
    for (std::thread& thread : *threads_) {
      thread.join();
    }
  }

  void work(int part) {
    for (std::uint32_t jobs_done = 0;; ++jobs_done) {
      wait_while(jobs_begun_, jobs_done);
      if (job_ == nullptr) {
        return;
      }
      (*job_)(part);
      if (at_work_.fetch_sub(1, std::memory_order_acq_rel) == 1) {
        at_work_.notify_one();
      }
    }
  }

  // To fall asleep and be woken takes some 50 us, a good part of a step of a thousand worlds.
  template <class Value>
  static void wait_while(const std::atomic<Value>& value, Value is) {
    constexpr std::chrono::microseconds patience{100};
    const auto sleeps_at = std::chrono::steady_clock::now() + patience;
    while (value.load(std::memory_order_acquire) == is) {
      if (std::chrono::steady_clock::now() >= sleeps_at) {
        value.wait(is, std::memory_order_acquire);
        return;
      }
    }
  }

  int size_;
  pid_t home_ = getpid();
  const std::function<void(int)>* job_ = nullptr;
  std::atomic<std::uint32_t> jobs_begun_ = 0;
  std::atomic<int> at_work_ = 0;
  std::unique_ptr<std::vector<std::thread>> threads_ = std::make_unique<std::vector<std::thread>>();
};

}  // namespace striker::training
