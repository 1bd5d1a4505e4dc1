// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/workers.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <map>
#include <stdexcept>
#include <system_error>

namespace striker::training {

namespace {

struct Worker {
  std::size_t task = 0;
  int complaint = -1;  // the reading end of a pipe
};

// In the worker: the work, and what went wrong as text.
[[noreturn]] void be_worker(std::size_t task, const std::function<void(std::size_t)>& work, int complaint) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  int code = 0;
  try {
    work(task);
  } catch (const std::exception& error) {
    const ssize_t written = write(complaint, error.what(), std::strlen(error.what()));
    code = written < 0 ? 2 : 1;
  }
  _exit(code);
}

std::pair<pid_t, Worker> start(std::size_t task, const std::function<void(std::size_t)>& work) {
  int ends[2];
  std::fflush(nullptr);
  const pid_t pid = pipe(ends) == 0 ? fork() : -1;
  if (pid < 0) {
    throw std::runtime_error(
        fmt::format("a worker process cannot be started ({})", std::generic_category().message(errno)));
  }
  if (pid == 0) {
    close(ends[0]);
    be_worker(task, work, ends[1]);
  }
  close(ends[1]);
  return {pid, {.task = task, .complaint = ends[0]}};
}

// Empty if it ended well.
std::string why_it_ended(int status, int complaint) {
  if (WIFSIGNALED(status)) {
    return fmt::format("its process was killed by signal {} ({})", WTERMSIG(status),
                       strsignal(WTERMSIG(status)));
  }
  if (WEXITSTATUS(status) == 0) {
    return {};
  }
  char text[1000];
  const ssize_t size = read(complaint, text, sizeof text);
  return size > 0 ? std::string(text, static_cast<std::size_t>(size)) : "it failed and said nothing";
}

}  // namespace

std::vector<WorkerFailure> run_workers(const std::vector<std::size_t>& tasks, int jobs,
                                       const std::function<void(std::size_t)>& work,
                                       const std::function<void(std::size_t)>& finished,
                                       const std::function<bool()>& stop) {
  std::map<pid_t, Worker> workers;
  std::vector<WorkerFailure> failures;
  auto next = tasks.begin();
  while (!workers.empty() || (next != tasks.end() && !stop())) {
    while (next != tasks.end() && !stop() && workers.size() < static_cast<std::size_t>(jobs)) {
      workers.insert(start(*next, work));
      ++next;
    }
    int status = 0;
    const pid_t pid = waitpid(-1, &status, 0);
    const auto ended = workers.find(pid);
    if (ended == workers.end()) {
      continue;  // interrupted by a signal
    }
    const std::string why = why_it_ended(status, ended->second.complaint);
    close(ended->second.complaint);
    const std::size_t task = ended->second.task;
    workers.erase(ended);
    if (why.empty()) {
      finished(task);
    } else {
      failures.push_back({.task = task, .why = why});
    }
  }
  std::sort(failures.begin(), failures.end(),
            [](const WorkerFailure& a, const WorkerFailure& b) { return a.task < b.task; });
  return failures;
}

}  // namespace striker::training
