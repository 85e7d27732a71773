#include "vigil/apps/report_command.hpp"

#include <fmt/format.h>

#include "vigil/adapters/report/write_report.hpp"
#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/recording_choice.hpp"
#include "vigil/apps/text_file.hpp"
#include "vigil/runtime/recording_playback.hpp"

namespace vigil::apps {
namespace {

namespace fs = std::filesystem;

/// Far more than any summary has.
constexpr std::uintmax_t kMostSummaryBytes = std::uintmax_t{16} << 20U;

std::optional<std::string> summary_of(const fs::path& directory) {
  const fs::path path = directory / "summary.json";
  if (!fs::is_regular_file(path)) return std::nullopt;
  return read_whole(path, kMostSummaryBytes);
}

}  // namespace

int report(const ReportArguments& arguments) {
  const fs::path& directory = arguments.directory;
  const ChosenRecording chosen = choose_recording(directory);
  const runtime::RecordedFlight flight = runtime::collect(*chosen.recording, chosen.mission);
  report::write_report({flight, chosen.mission, summary_of(directory)}, directory);
  fmt::print("{}\n", (directory / "report.html").string());
  return kDone;
}

}  // namespace vigil::apps
