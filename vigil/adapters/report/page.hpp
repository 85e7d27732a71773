#pragma once

#include <string>
#include <vector>

#include "vigil/adapters/report/coverage_map.hpp"
#include "vigil/adapters/report/findings.hpp"
#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/adapters/report/summary_facts.hpp"

namespace vigil::report {

/// A figure of the page with what the paper says of it.
struct PageFigure {
  std::string file;  ///< its name below figures/, without extension
  std::string title;
  std::string note;  ///< what is drawn
  std::string svg;   ///< as gnuplot wrote it
  std::vector<Finding> findings;
};

/// The whole of report.html: nothing in it refers to another place but links to the figures' own files beside it.
[[nodiscard]] std::string page(const FlightData& data, const CoverageMap& map, const SummaryFacts& facts,
                               const std::vector<PageFigure>& figures);

}  // namespace vigil::report
