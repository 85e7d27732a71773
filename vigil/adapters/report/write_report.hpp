#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "vigil/runtime/mission.hpp"
#include "vigil/runtime/recorded_flight.hpp"

namespace vigil::report {

/// What a report is made of.
struct ReportInput {
  const runtime::RecordedFlight& flight;
  const runtime::Mission& mission;          ///< that was flown (recording/mission.yaml)
  std::optional<std::string> summary_json;  ///< the text of summary.json; none: a report from the recording alone
};

struct ReportOptions {
  std::string gnuplot = "gnuplot";  ///< the program that draws: a name in PATH, or a path
};

/// Writes DIRECTORY/report.html, which needs nothing else to be read, and DIRECTORY/figures/fig4_metric.svg, .png, ...:
/// the paper's figures 4 to 8 of this flight. Each file appears whole or not at all; earlier ones are replaced.
/// GnuplotMissing where the program is not there, ReportError where anything else fails.
void write_report(const ReportInput& input, const std::filesystem::path& directory, const ReportOptions& options = {});

}  // namespace vigil::report
