#include "vigil/adapters/report/gnuplot.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/report/report_error.hpp"
#include "vigil/adapters/report/report_folder_for_tests.hpp"

namespace vigil::report {
namespace {

const Figure kLine{"line", 300, 200, "$line << EOD\n0 0\n1 1\nEOD\n", "plot $line using 1:2 with lines"};

TEST(Literal, Holds_nothing_but_text) {
  EXPECT_EQ(literal("cf1"), "'cf1'");
  EXPECT_EQ(literal("it's"), "'it\u2019s'");
  EXPECT_EQ(literal("`touch x` @y \\n\n"), "'_touch x_ _y _n_'");
}

TEST(Draw, Names_that_look_like_commands_stay_text) {
  const TemporaryFolder folder;
  Figure figure = kLine;
  figure.commands = "set title " + literal("'; system 'touch pwned'; `touch pwned` '") + "\nplot $line using 1:2";
  draw({figure}, folder.path(), "gnuplot");
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "pwned"));
  EXPECT_NE(contents(folder.path() / "line.svg").find("system"), std::string::npos);
}

TEST(Draw, A_missing_program_is_told_with_how_to_get_it) {
  const TemporaryFolder folder;
  try {
    draw({kLine}, folder.path(), "no-such-gnuplot");
    FAIL();
  } catch (const GnuplotMissing& error) {
    EXPECT_NE(std::string(error.what()).find("apt-get install gnuplot-nox"), std::string::npos);
  }
}

TEST(Draw, What_gnuplot_complains_of_is_passed_on) {
  const TemporaryFolder folder;
  Figure figure = kLine;
  figure.commands = "plot nonsense(";
  try {
    draw({figure}, folder.path(), "gnuplot");
    FAIL();
  } catch (const ReportError& error) {
    EXPECT_NE(std::string(error.what()).find("nonsense"), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
  }
}

TEST(Draw, A_program_that_draws_nothing_is_found_out) {
  const TemporaryFolder folder;
  EXPECT_THROW(draw({kLine}, folder.path(), "true"), ReportError);
}

}  // namespace
}  // namespace vigil::report
