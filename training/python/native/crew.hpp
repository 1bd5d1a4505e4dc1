// SPDX-License-Identifier: Apache-2.0
// Threads that do one job together, again and again: a job's parts 0 to size - 1, each by its own thread, the first by
// the caller's. The threads wait between two jobs; a job begins and ends in a few microseconds.
//
// A process that was forked off has no threads of its parent's: `run` there throws std::runtime_error. A crew of one has
// none at all, and runs anywhere. Where the system gives fewer threads, the constructor throws std::runtime_error.
#pragma once

#include <unistd.h>

#include <barrier>
#include <cstddef>
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
  explicit Crew(int size) : size_(size), gate_(size) {
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
    gate_.arrive_and_wait();
    job(0);
    gate_.arrive_and_wait();
  }

 private:
  // Of the threads that there are, which wait for the others.
  void end() {
    job_ = nullptr;
    static_cast<void>(gate_.arrive(size_ - static_cast<int>(threads_->size())));
    for (std::thread& thread : *threads_) {
      thread.join();
    }
  }

  void work(int part) {
    for (;;) {
      gate_.arrive_and_wait();
      if (job_ == nullptr) {
        return;
      }
      (*job_)(part);
      gate_.arrive_and_wait();
    }
  }

  int size_;
  pid_t home_ = getpid();
  const std::function<void(int)>* job_ = nullptr;
  std::barrier<> gate_;
  std::unique_ptr<std::vector<std::thread>> threads_ = std::make_unique<std::vector<std::thread>>();
};

}  // namespace striker::training
