// The console of the check program on the host.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>

#include "tests/images/console.hpp"

namespace striker::images::console {

namespace {

std::map<int, std::FILE*> open_files;

// Without a main of its own: the arguments come from where Linux keeps them.
const char* find_word(const char* name) {
  static char line[4096];
  std::FILE* file = std::fopen("/proc/self/cmdline", "rb");
  if (file == nullptr) {
    return nullptr;
  }
  const std::size_t size = std::fread(line, 1, sizeof line - 2, file);
  std::fclose(file);
  for (const char* word = line; word < line + size; word += std::strlen(word) + 1) {
    if (std::strcmp(word, name) == 0) {
      return word + std::strlen(word) + 1;
    }
  }
  return nullptr;
}

}  // namespace

void print(const char* text) {
  std::fputs(text, stdout);
}

void print(std::int64_t number) {
  std::printf("%lld", static_cast<long long>(number));
}

void print_line(const char* name, std::int64_t number) {
  print(name);
  print(" ");
  print(number);
  print("\n");
}

const char* word_argument(const char* name) {
  return find_word(name);
}

std::uint32_t argument(const char* name, std::uint32_t otherwise) {
  const char* word = find_word(name);
  return word == nullptr ? otherwise : static_cast<std::uint32_t>(std::strtoul(word, nullptr, 10));
}

File::File(const char* name) : handle_(-1) {
  if (std::FILE* file = std::fopen(name, "rb"); file != nullptr) {
    handle_ = fileno(file);
    open_files[handle_] = file;
  }
}

File::~File() {
  if (is_open()) {
    std::fclose(open_files[handle_]);
    open_files.erase(handle_);
  }
}

bool File::read(std::span<std::uint8_t> bytes) {
  return std::fread(bytes.data(), 1, bytes.size(), open_files.at(handle_)) == bytes.size();
}

void exit(int status) {
  std::fflush(stdout);
  std::exit(status);
}

}  // namespace striker::images::console
