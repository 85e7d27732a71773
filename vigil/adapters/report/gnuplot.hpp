#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace vigil::report {

/// One figure: gnuplot commands that draw it into whatever terminal is set, and its size on paper (or screen).
struct Figure {
  std::string name;  ///< of its files, without extension: [a-z0-9_]
  int width_px = 800;
  int height_px = 400;
  std::string data;  ///< named data blocks; names are shared by all figures of a script
  std::string commands;
};

/// Text as a gnuplot string literal that can hold nothing but text: no substitution, no escape, no line end.
[[nodiscard]] std::string literal(std::string_view text);

/// Draws the figures as NAME.svg and NAME.png into `folder`, which exists, by one run of the program `gnuplot` (a name
/// that is looked up in PATH, or a path), without a shell and without the user's own gnuplot settings. GnuplotMissing
/// where there is no such program; ReportError with gnuplot's own words where it fails.
void draw(const std::vector<Figure>& figures, const std::filesystem::path& folder, const std::string& gnuplot);

}  // namespace vigil::report
