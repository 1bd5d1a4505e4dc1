// SPDX-License-Identifier: Apache-2.0
// Preloaded into striker-firmware: from the first deadline of its main thread to the one that STRIKER_TICKS
// names, any thread that allocates or frees ends the process, with the name of what it called on stderr.
// operator new and delete come here by way of malloc and free.
#include <dlfcn.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <cstring>
#include <ctime>

// glibc's own names for what is behind malloc and its kin.
// NOLINTBEGIN(bugprone-reserved-identifier)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* block, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
void __libc_free(void* block);
}
// NOLINTEND(bugprone-reserved-identifier)

namespace {

std::atomic<bool> forbidden = false;
unsigned long deadlines = 0;

void say(const char* text) {
  static_cast<void>(!write(STDERR_FILENO, text, std::strlen(text)));
}

void check(const char* what) {
  if (forbidden.load(std::memory_order_relaxed)) {
    forbidden = false;
    say("no_allocation: ");
    say(what);
    say(" after initialisation\n");
    std::abort();
  }
}

}  // namespace

extern "C" {

void* malloc(std::size_t size) {
  check("malloc");
  return __libc_malloc(size);
}

void* calloc(std::size_t count, std::size_t size) {
  check("calloc");
  return __libc_calloc(count, size);
}

void* realloc(void* block, std::size_t size) {
  check("realloc");
  return __libc_realloc(block, size);
}

void* memalign(std::size_t alignment, std::size_t size) {
  check("memalign");
  return __libc_memalign(alignment, size);
}

void* aligned_alloc(std::size_t alignment, std::size_t size) {
  check("aligned_alloc");
  return __libc_memalign(alignment, size);
}

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  check("posix_memalign");
  *block = __libc_memalign(alignment, size);
  return *block == nullptr ? 12 : 0;  // ENOMEM
}

void free(void* block) {
  if (block != nullptr) {
    check("free");
  }
  __libc_free(block);
}

int clock_nanosleep(clockid_t clock, int flags, const timespec* time, timespec* rest) {
  using Function = int (*)(clockid_t, int, const timespec*, timespec*);
  static const auto real = reinterpret_cast<Function>(dlsym(RTLD_NEXT, "clock_nanosleep"));
  if (syscall(SYS_gettid) != getpid()) {
    return real(clock, flags, time, rest);
  }
  ++deadlines;
  if (deadlines == 2) {
    forbidden = true;
  } else if (deadlines == std::strtoul(std::getenv("STRIKER_TICKS"), nullptr, 10)) {
    forbidden = false;
    say("no_allocation: none\n");
  }
  const char* provoked = std::getenv("STRIKER_PROVOKE");
  if (provoked != nullptr && deadlines == 100) {
    std::free(strdup(provoked));
  }
  return real(clock, flags, time, rest);
}
}
