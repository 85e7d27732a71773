#include "vigil/adapters/report/write_report.hpp"

#include <fstream>
#include <iterator>
#include <limits>
#include <unistd.h>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "vigil/adapters/report/coverage_map.hpp"
#include "vigil/adapters/report/figures.hpp"
#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/adapters/report/gnuplot.hpp"
#include "vigil/adapters/report/page.hpp"
#include "vigil/adapters/report/page_figures.hpp"
#include "vigil/adapters/report/report_error.hpp"
#include "vigil/adapters/report/summary_facts.hpp"
#include "vigil/runtime/mission_setup.hpp"
#include "vigil/runtime/recorded_targets.hpp"

namespace vigil::report {
namespace {

namespace fs = std::filesystem;

constexpr double kAtTheEnd = std::numeric_limits<double>::infinity();

/// A folder beside the report's own in which everything is made before it is moved into place.
class Workshop {
 public:
  explicit Workshop(const fs::path& directory) {
    std::string name = (directory / ".report-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) {
      throw ReportError(
          fmt::format("{}: cannot write into it; check that it exists and its permissions", directory.string()));
    }
    path_ = fs::absolute(name);
  }
  ~Workshop() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  Workshop(const Workshop&) = delete;
  Workshop& operator=(const Workshop&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

std::string contents(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush())
    throw ReportError(fmt::format("{}: cannot write it; check that there is room on the disk", path.string()));
}

void move_into_place(const fs::path& from, const fs::path& to) {
  std::error_code error;
  fs::create_directories(to.parent_path(), error);
  if (!error) fs::rename(from, to, error);
  if (error)
    throw ReportError(fmt::format("{}: cannot put it there: {}; check the folder", to.string(), error.message()));
}

std::vector<Eigen::ArrayXXd> maps_of_snapshots(const FlightData& data, const CoverageMap& map,
                                               const ReportInput& input) {
  std::vector<Eigen::ArrayXXd> maps;
  for (const double time_s : snapshot_times(data)) {
    const runtime::Mission then = runtime::mission_at(input.mission, input.flight.targets, time_s);
    maps.push_back(runtime::targets_of(then) == runtime::targets_of(data.mission)
                       ? map.wanted
                       : wanted_on_grid(data, map, runtime::importance(then)));
  }
  return maps;
}

}  // namespace

void write_report(const ReportInput& input, const fs::path& directory, const ReportOptions& options) {
  const runtime::Mission mission = runtime::mission_at(input.mission, input.flight.targets, kAtTheEnd);
  const FlightData data = prepare(input.flight, mission);
  const CoverageMap map = coverage_map(data, runtime::importance(mission));
  std::vector<PageFigure> figures = page_figures(data, map);

  const Workshop workshop(directory);
  draw({metric_figure(data), density_figure(data, map), input_figure(data),
        snapshot_figure(data, map, maps_of_snapshots(data, map, input)), distance_figure(data)},
       workshop.path(), options.gnuplot);
  for (PageFigure& figure : figures) figure.svg = contents(workshop.path() / (figure.file + ".svg"));
  write_text(workshop.path() / "report.html", page(data, map, summary_facts(data, input.summary_json), figures));

  for (const PageFigure& figure : figures) {
    for (const char* extension : {".svg", ".png"}) {
      const std::string name = figure.file + extension;
      move_into_place(workshop.path() / name, directory / "figures" / name);
    }
  }
  move_into_place(workshop.path() / "report.html", directory / "report.html");
}

}  // namespace vigil::report
