#include "vigil/apps/export_command.hpp"

#include <fmt/format.h>

#include "vigil/adapters/recording/csv_recorder.hpp"
#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/recording_choice.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/runtime/recording_playback.hpp"

namespace vigil::apps {

int export_tables(const ExportOptions& options) {
  const ChosenRecording chosen = choose_recording(options.directory);
  create_results("--out", options.out);
  recording::CsvRecorder tables(options.out, chosen.recording->head().mission_text);
  runtime::play(*chosen.recording, chosen.mission, tables);
  const std::string& incomplete = chosen.recording->incomplete_reason();
  if (!incomplete.empty()) fmt::print(stderr, "vigil: the recording is not whole: {}\n", incomplete);
  fmt::print("{}\n", in_words(options.out));
  return kDone;
}

}  // namespace vigil::apps
