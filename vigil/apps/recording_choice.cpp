#include "vigil/apps/recording_choice.hpp"

#include <fmt/format.h>

#include "vigil/adapters/recording/bag_recording.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::apps {

ChosenRecording choose_recording(const std::filesystem::path& directory) {
  std::error_code error;
  if (!std::filesystem::is_directory(directory / "recording", error))
    throw Failure(kBadInput,
                  fmt::format("{}: no recording here; name a directory that `vigil simulate --out` or `vigil serve "
                              "--record` wrote",
                              in_words(directory)));
  auto recording = std::make_unique<recording::BagRecording>(directory);
  runtime::Mission mission =
      runtime::parse_mission(recording->head().mission_text, in_words(directory / "recording" / "mission.yaml"));
  return {std::move(recording), std::move(mission)};
}

}  // namespace vigil::apps
