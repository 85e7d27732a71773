#include "vigil/adapters/report/write_report.hpp"

#include <array>
#include <regex>
#include <vector>

#include <gtest/gtest.h>

#include "vigil/adapters/report/flight_data.hpp"
#include "vigil/adapters/report/report_error.hpp"
#include "vigil/adapters/report/report_folder_for_tests.hpp"
#include "vigil/adapters/report/sample_flight.hpp"

namespace vigil::report {
namespace {

constexpr std::array kFigures{"fig4_metric", "fig5_density", "fig6_inputs", "fig7_snapshots", "fig8_distances"};
std::size_t count_of(const std::string& text, const std::string& words) {
  std::size_t count = 0;
  for (std::size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++count;
  return count;
}

/// How many curves, clouds of points and pictures of data a figure has.
std::size_t series_of(const std::filesystem::path& directory, const std::string& figure) {
  return count_of(contents(directory / "figures" / (figure + ".svg")), "<g id=\"gnuplot_plot_");
}

struct Report {
  TemporaryFolder folder;
  SampleOptions options;
  runtime::RecordedFlight flight;
  runtime::Mission mission;

  explicit Report(SampleOptions chosen = {})
      : options(chosen), flight(sample_flight(chosen)), mission(sample_mission(chosen)) {}
  std::string write(const ReportOptions& how = {}) {
    write_report({flight, mission, "{}"}, folder.path(), how);
    return contents(folder.path() / "report.html");
  }
};

TEST(WriteReport, Every_figure_is_a_whole_SVG_and_a_whole_PNG) {
  Report report;
  report.write();
  for (const char* name : kFigures) {
    const std::string svg = contents(report.folder.path() / "figures" / (std::string(name) + ".svg"));
    EXPECT_TRUE(svg.starts_with("<?xml")) << name;
    EXPECT_NE(svg.find("</svg>", svg.size() - 20), std::string::npos) << name;
    EXPECT_EQ(count_of(svg, "<g "), count_of(svg, "</g>")) << name;
    const std::string png = contents(report.folder.path() / "figures" / (std::string(name) + ".png"));
    EXPECT_TRUE(png.starts_with("\x89PNG\r\n")) << name;
    EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND") << name;
  }
}

TEST(WriteReport, Nothing_but_the_report_is_left_behind) {
  Report report;
  report.write();
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(report.folder.path()))
    names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"figures", "report.html"}));
}

TEST(WriteReport, Each_drone_and_each_pair_has_its_curves) {
  Report three;
  Report four({.drones = 4});
  three.write();
  four.write();
  EXPECT_EQ(series_of(three.folder.path(), "fig4_metric"), 2U);
  EXPECT_EQ(series_of(three.folder.path(), "fig6_inputs"), 3U * 4U);
  EXPECT_EQ(series_of(four.folder.path(), "fig6_inputs"), 4U * 4U);
  EXPECT_EQ(series_of(three.folder.path(), "fig8_distances"), 3U * 3U);
  EXPECT_EQ(series_of(four.folder.path(), "fig8_distances"), 6U * 3U);
  // Its way and its name in the legend; in each of three snapshots its way, once its name.
  EXPECT_EQ(series_of(four.folder.path(), "fig5_density"), series_of(three.folder.path(), "fig5_density") + 2U);
  EXPECT_EQ(series_of(four.folder.path(), "fig7_snapshots"), series_of(three.folder.path(), "fig7_snapshots") + 4U);
}

TEST(WriteReport, A_crowd_is_shown_by_its_distribution) {
  Report report({.drones = 80, .duration_s = 20.0});
  report.write();
  EXPECT_EQ(series_of(report.folder.path(), "fig6_inputs"), 4U);
  EXPECT_EQ(series_of(report.folder.path(), "fig8_distances"), 4U);
}

TEST(WriteReport, Of_very_many_drones_some_are_drawn_and_the_page_says_so) {
  Report report({.drones = 2500, .duration_s = 0.4});
  for (std::size_t tick = 0; tick < report.flight.ticks.active.size(); ++tick) {
    report.flight.ticks.active[tick] = 1500;
    for (std::size_t i = 0; i < 1000; ++i)
      report.flight.rows.activity[report.flight.row(tick, i)] = swarm::Activity::kGrounded;
  }
  const std::string page = report.write();
  EXPECT_LT(series_of(report.folder.path(), "fig5_density"), kMostDrawn + 20U);
  EXPECT_LT(page.size(), 4U << 20U);
  EXPECT_NE(page.find("Maps draw 400 of the 2500 drones, evenly chosen; all else is of all drones."),
            std::string::npos);
  EXPECT_NE(page.find("the last part of the ways of 400 of the 2500 drones"), std::string::npos);
  EXPECT_NE(page.find("crosses: drones that are not active, 400 of them at most"), std::string::npos);
}

TEST(WriteReport, A_page_of_few_drones_and_all_ticks_leaves_nothing_out) {
  Report report;
  const std::string page = report.write();
  EXPECT_EQ(page.find("evenly chosen"), std::string::npos);
  EXPECT_EQ(page.find("Of the recorded ticks"), std::string::npos);
}

TEST(WriteReport, Where_ticks_were_left_out_the_page_says_which) {
  Report report;
  report.flight.every = 3;
  EXPECT_NE(report.write().find("Of the recorded ticks each 3rd and the last are looked at"), std::string::npos);
}

TEST(WriteReport, The_page_refers_to_no_other_place) {
  Report report;
  const std::string page = report.write();
  EXPECT_EQ(page.find("http:"), std::string::npos);
  EXPECT_EQ(page.find("https:"), std::string::npos);
  const std::regex reference("(?:src|href)=[\"']([^\"']{0,12})");
  std::size_t references = 0;
  for (std::sregex_iterator it(page.begin(), page.end(), reference), end; it != end; ++it, ++references) {
    const std::string to = (*it)[1];
    EXPECT_TRUE(to.starts_with("#") || to.starts_with("data:image/p") || to.starts_with("figures/fig")) << to;
  }
  EXPECT_GT(references, 10U);
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

TEST(WriteReport, The_figures_in_the_page_take_the_colour_of_its_text_and_unique_identifiers) {
  Report report;
  const std::string page = report.write();
  EXPECT_NE(page.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_EQ(page.find("\"black\""), std::string::npos);
  EXPECT_EQ(page.find("rgb(  0,   0,   0)"), std::string::npos);
  EXPECT_EQ(count_of(page, "<svg role=\"img\""), 5U);
  for (const char* name : kFigures) EXPECT_EQ(count_of(page, " id='" + std::string(name) + "-gpDot'"), 1U) << name;
  EXPECT_EQ(count_of(page, " id='gpDot'"), 0U);
}

TEST(WriteReport, The_same_flight_gives_the_same_page) {
  Report a;
  Report b;
  EXPECT_EQ(a.write(), b.write());
}

TEST(WriteReport, Names_from_a_mission_file_cannot_become_markup_or_commands) {
  Report report;
  report.mission.name = "<script>alert(1)</script>";
  report.mission.targets.clusters[0].name = "\"><img src=x>";
  report.flight.targets[0].clusters[0].name = "\"><img src=x>";
  report.mission.drones[0].id = "'`touch pwned`'<b>";
  report.flight.drones[0] = "'`touch pwned`'<b>";
  const std::string page = report.write();
  EXPECT_EQ(page.find("<script"), std::string::npos);
  EXPECT_EQ(page.find("<img"), std::string::npos);
  EXPECT_EQ(page.find("<b>'"), std::string::npos);
}

TEST(WriteReport, Odd_flights_are_drawn_too) {
  for (const SampleOptions& options :
       {SampleOptions{.drones = 1, .duration_s = 5.0}, SampleOptions{.drones = 2, .duration_s = 0.0},
        SampleOptions{.drones = 13, .duration_s = 2.0},
        SampleOptions{.drones = 2, .duration_s = 1500.0, .rate_hz = 1.0}}) {
    Report report(options);
    EXPECT_FALSE(report.write().empty());
  }
}

TEST(WriteReport, A_flight_in_which_nothing_was_covered_is_drawn_too) {
  Report report;
  report.mission.targets.clusters.clear();
  report.flight.targets = {{0.0, {}, {}}};
  for (swarm::Activity& activity : report.flight.rows.activity) activity = swarm::Activity::kGrounded;
  for (double& percent : report.flight.ticks.metric_percent) percent = std::nan("");
  for (Vec2& place : report.flight.rows.true_position_m) place = Vec2::Constant(std::nan(""));
  for (Vec2& place : report.flight.rows.position_m) place = Vec2::Constant(std::nan(""));
  for (runtime::Clearances& clearances : report.flight.ticks.clearances) clearances = {};
  EXPECT_NE(report.write().find("there is no metric"), std::string::npos);
}

TEST(WriteReport, Without_gnuplot_nothing_is_written) {
  Report report;
  EXPECT_THROW(report.write({.gnuplot = "no-such-gnuplot"}), GnuplotMissing);
  EXPECT_TRUE(std::filesystem::is_empty(report.folder.path()));
}

TEST(WriteReport, A_folder_that_is_not_there_is_named) {
  const Report report;
  try {
    write_report({report.flight, report.mission, {}}, report.folder.path() / "absent");
    FAIL();
  } catch (const ReportError& error) {
    EXPECT_NE(std::string(error.what()).find("absent: cannot write into it"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace vigil::report
