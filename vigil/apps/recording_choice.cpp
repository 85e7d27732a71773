#include "vigil/apps/recording_choice.hpp"

#include <fmt/format.h>

#include "vigil/adapters/recording/bag_recording.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/apps/text_file.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {

namespace {

/// The bag has the mission that was flown; the file beside it is for people, who may have changed it since.
void tell_of_edited_mission(const std::filesystem::path& path, const std::string& flown) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return;
  const bool is_same =
      std::filesystem::file_size(path, error) == flown.size() && read_whole(path, flown.size()) == flown;
  if (!is_same)
    fmt::print(
        stderr,
        "vigil: {} is not the mission that was flown any more; the one that was stands in the bag, and is used\n",
        in_words(path));
}

}  // namespace

ChosenRecording choose_recording(const std::filesystem::path& directory) {
  std::error_code error;
  if (!std::filesystem::is_directory(directory / "recording", error))
    throw Failure(kBadInput,
                  fmt::format("{}: no recording here; name a directory that `vigil simulate --out` or `vigil serve "
                              "--record` wrote",
                              in_words(directory)));
  auto recording = std::make_unique<recording::BagRecording>(directory);
  const std::filesystem::path mission_file = directory / "recording" / "mission.yaml";
  runtime::Mission mission = runtime::parse_mission(recording->head().mission_text, in_words(mission_file));
  tell_of_edited_mission(mission_file, recording->head().mission_text);
  return {std::move(recording), std::move(mission)};
}

}  // namespace vigil::apps
