#include "vigil/apps/export_command.hpp"

#include <fmt/format.h>

#include "vigil/adapters/geography/geojson.hpp"
#include "vigil/adapters/geography/kml.hpp"
#include "vigil/adapters/recording/csv_recorder.hpp"
#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/recording_choice.hpp"
#include "vigil/apps/results_folder.hpp"
#include "vigil/apps/text_file.hpp"
#include "vigil/runtime/recording_playback.hpp"

namespace vigil::apps {
namespace {

void export_maps(const ChosenRecording& chosen, const ExportOptions& options) {
  geography::TrackRecorder recorder(options.track_step_s);
  runtime::play(*chosen.recording, chosen.mission, recorder);
  const geography::MappedFlight flight{.mission = chosen.mission,
                                       .targets = recorder.last_targets(),
                                       .tracks = recorder.tracks(),
                                       .began_ns = chosen.recording->head().began_ns};
  write_whole(options.out / "tracks.geojson", geography::geojson(flight));
  write_whole(options.out / "tracks.kml", geography::kml(flight));
}

}  // namespace

int export_recording(const ExportOptions& options) {
  const ChosenRecording chosen = choose_recording(options.directory);
  create_results("--out", options.out);
  recording::CsvRecorder tables(options.out, chosen.recording->head().mission_text);
  runtime::play(*chosen.recording, chosen.mission, tables);
  if (chosen.mission.field.datum)
    export_maps(chosen, options);
  else
    fmt::print(stderr,
               "vigil: no maps: the mission has no field.datum, which says where on the earth its field lies\n");
  const std::string& incomplete = chosen.recording->incomplete_reason();
  if (!incomplete.empty()) fmt::print(stderr, "vigil: the recording is not whole: {}\n", incomplete);
  fmt::print("{}\n", in_words(options.out));
  return kDone;
}

}  // namespace vigil::apps
