// SPDX-License-Identifier: Apache-2.0
#include "sil/scenario/runs/worker_pool.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <vector>

namespace striker::sil {

namespace {

using Clock = std::chrono::steady_clock;
constexpr int poll_ms = 200;

// In the worker's lines: a result, or what an exception said.
constexpr char result_mark = '+';
constexpr char failure_mark = '-';

// Every `stride`th task from `next` on is its own.
struct Worker {
  pid_t process = -1;
  int output = -1;
  std::size_t next = 0;
  std::string text;  // of a line that is not complete
  Clock::time_point heard;
};

void write_all(int file, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = write(file, text.data(), text.size());
    if (written <= 0) {
      _exit(2);
    }
    text.remove_prefix(static_cast<std::size_t>(written));
  }
}

class Pool {
 public:
  Pool(std::span<const std::uint64_t> tasks, const PoolSize& size,
       const std::function<std::string(std::uint64_t)>& work,
       const std::function<void(const PoolResult&)>& done)
      : tasks_(tasks),
        longest_run_(size.longest_run),
        work_(&work),
        done_(&done),
        workers_(static_cast<std::size_t>(size.jobs)) {
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      workers_[i].next = i;
      start(workers_[i]);
    }
  }

  ~Pool() {
    for (Worker& worker : workers_) {
      end(worker);
    }
  }

  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  [[nodiscard]] bool busy() const {
    for (const Worker& worker : workers_) {
      if (worker.process >= 0) {
        return true;
      }
    }
    return false;
  }

  void wait() {
    std::vector<pollfd> waiting;
    for (const Worker& worker : workers_) {
      waiting.push_back({.fd = worker.output, .events = POLLIN, .revents = 0});
    }
    poll(waiting.data(), waiting.size(), poll_ms);
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      if (waiting[i].revents != 0) {
        hear(workers_[i]);
      } else if (workers_[i].process >= 0 && Clock::now() - workers_[i].heard > longest_run_) {
        fail(workers_[i], fmt::format("no result within {} s", longest_run_.count()));
      }
    }
  }

 private:
  void start(Worker& worker) {
    if (worker.next >= tasks_.size()) {
      return;
    }
    int ends[2];
    std::fflush(nullptr);
    const pid_t process = pipe(ends) == 0 ? fork() : -1;
    if (process < 0) {
      throw std::runtime_error(
          fmt::format("a worker process cannot be started ({})", std::generic_category().message(errno)));
    }
    if (process == 0) {
      close(ends[0]);
      be_worker(worker.next, ends[1]);
    }
    close(ends[1]);
    worker.process = process;
    worker.output = ends[0];
    worker.text.clear();
    worker.heard = Clock::now();
  }

  [[noreturn]] void be_worker(std::size_t first, int output) const {
    std::signal(SIGINT, SIG_DFL);
    std::signal(SIGTERM, SIG_DFL);
    for (std::size_t i = first; i < tasks_.size(); i += workers_.size()) {
      std::string line;
      try {
        line = result_mark + (*work_)(tasks_[i]);
      } catch (const std::exception& error) {
        line = failure_mark + std::string(error.what());
      }
      write_all(output, line + '\n');
    }
    _exit(0);
  }

  void hear(Worker& worker) {
    char bytes[65536];
    const ssize_t size = read(worker.output, bytes, sizeof bytes);
    if (size < 0 && errno == EINTR) {
      return;
    }
    if (size <= 0) {
      const int status = end(worker);
      if (worker.next < tasks_.size()) {
        fail(worker, WIFSIGNALED(status) ? fmt::format("killed by signal {} ({})", WTERMSIG(status),
                                                       strsignal(WTERMSIG(status)))
                                         : "its process ended early");
      }
      return;
    }
    worker.heard = Clock::now();
    worker.text.append(bytes, static_cast<std::size_t>(size));
    for (std::size_t end = worker.text.find('\n'); end != std::string::npos; end = worker.text.find('\n')) {
      tell(worker, worker.text.substr(0, end));
      worker.text.erase(0, end + 1);
    }
  }

  void tell(Worker& worker, const std::string& line) {
    PoolResult result{.task = tasks_[worker.next], .line = {}, .failure = {}};
    (line[0] == result_mark ? result.line : result.failure) = line.substr(1);
    worker.next += workers_.size();
    (*done_)(result);
  }

  // The task that it was at is lost; another process goes on with the next one.
  void fail(Worker& worker, const std::string& why) {
    end(worker);
    const std::uint64_t task = tasks_[worker.next];
    worker.next += workers_.size();
    (*done_)({.task = task, .line = {}, .failure = why});
    start(worker);
  }

  static int end(Worker& worker) {
    int status = 0;
    if (worker.process >= 0) {
      kill(worker.process, SIGKILL);
      waitpid(worker.process, &status, 0);
      close(worker.output);
      worker.process = -1;
      worker.output = -1;
    }
    return status;
  }

  std::span<const std::uint64_t> tasks_;
  std::chrono::seconds longest_run_;
  const std::function<std::string(std::uint64_t)>* work_;
  const std::function<void(const PoolResult&)>* done_;
  std::vector<Worker> workers_;
};

}  // namespace

void run_in_processes(std::span<const std::uint64_t> tasks, const PoolSize& size,
                      const std::function<std::string(std::uint64_t)>& work,
                      const std::function<void(const PoolResult&)>& done, const std::function<bool()>& stop) {
  Pool pool(tasks, size, work, done);
  while (pool.busy() && !stop()) {
    pool.wait();
  }
}

}  // namespace striker::sil
