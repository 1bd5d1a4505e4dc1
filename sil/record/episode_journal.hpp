// SPDX-License-Identifier: Apache-2.0
// The finished episodes of a run that may end at any moment: a line of JSON each, handed to the kernel as the episode
// ends, in FILE.episodes.jsonl beside the summary FILE, which takes its place.
#pragma once

#include <cstdio>
#include <filesystem>
#include <functional>
#include <string>

#include "sil/record/observer.hpp"

namespace striker::sil {

class EpisodeJournal final : public Observer {
 public:
  // `row` gives the line of the episode that has just ended. Throws std::runtime_error that names the file, as does
  // writing. Without `done` the journal stays.
  EpisodeJournal(const std::filesystem::path& summary, std::function<std::string()> row);
  ~EpisodeJournal() override;
  EpisodeJournal(const EpisodeJournal&) = delete;
  EpisodeJournal& operator=(const EpisodeJournal&) = delete;

  void end_episode() override;

  // The summary is there.
  void done();

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }

 private:
  std::filesystem::path file_;
  std::function<std::string()> row_;
  std::FILE* stream_;
};

}  // namespace striker::sil
