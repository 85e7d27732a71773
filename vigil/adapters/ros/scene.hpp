#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

/// What is shown over ROS, in plain C++17: the seam between the program and the files that speak to roscpp, whose
/// headers do not compile as C++20. Metres, world frame (ROS: "world"), z up.
namespace vigil::ros_bridge {

struct Point {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
};

/// Shares of full, [0, 1].
struct Colour {
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  float alpha = 1.0F;
};

/// One thing to draw. A later one with the same set and id takes its place.
struct Mark {
  enum class Kind : std::uint8_t { kLineStrip, kLines, kPoints, kCylinder, kBox, kText };
  std::string set;
  int id = 0;
  Kind kind = Kind::kLineStrip;
  Colour colour;
  Point place;
  double yaw_rad = 0.0;
  Point size;                 ///< of lines: x is their width; of points: x and y; of text: z is its height
  std::vector<Point> points;  ///< of lines and points; a strip of fewer than two is taken away
  std::string text;
};

/// A density on a regular grid of cells, row by row from the field's corner.
struct DensityPicture {
  std::size_t columns = 0;
  std::size_t rows = 0;
  double column_m = 0.0;                ///< width of a cell
  double row_m = 0.0;                   ///< its height
  Point corner;                         ///< of the first cell
  double yaw_rad = 0.0;                 ///< from the world's x axis along a row
  std::vector<float> share_of_highest;  ///< columns x rows values in [0, 1]; NaN: nobody may look there
};

/// A number for plots, on topic "/vigil/<name>".
struct Figure {
  std::string name;
  double value = 0.0;
};

/// How one drone fares.
struct Diagnosis {
  enum class Level : std::uint8_t { kOk, kWarning, kError, kStale };
  std::string name;
  Level level = Level::kOk;
  std::string summary;
  std::vector<std::pair<std::string, std::string>> values;
};

}  // namespace vigil::ros_bridge
