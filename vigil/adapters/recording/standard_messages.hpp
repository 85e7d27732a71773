#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vigil/adapters/recording/cdr_writer.hpp"
#include "vigil/core/field/density.hpp"
#include "vigil/core/field/field.hpp"

/// Messages of ROS 2's own packages, for other tools. World frame: `map`, x east or as the mission has it, z up.
namespace vigil::recording {

/// Where a drone is, or was.
struct Place {
  Vec2 position = Vec2::Zero();
  double height_m = 0.0;
};

void write_pose(CdrWriter& writer, std::int64_t stamp_ns, const Place& place);
void write_twist(CdrWriter& writer, std::int64_t stamp_ns, const Vec2& velocity_m_s);
void write_path(CdrWriter& writer, std::int64_t stamp_ns, std::span<const Place> places);
void write_number(CdrWriter& writer, double value);

/// The density as shares of its highest value, 0 to 100. Cells that are nearly square.
void write_grid(CdrWriter& writer, std::int64_t stamp_ns, const field::DensityGrid& density,
                const field::WorldFrame& frame);

/// One line of a diagnostic: what, and how it is.
struct DroneDiagnosis {
  enum class Level : std::uint8_t { kOk, kWarning, kError, kStale };
  Level level = Level::kOk;
  std::string drone;
  std::string message;
  std::vector<std::pair<std::string, std::string>> values;
};
void write_diagnoses(CdrWriter& writer, std::int64_t stamp_ns, std::span<const DroneDiagnosis> diagnoses);

/// Points or a line to draw.
struct Drawing {
  enum class Kind : std::int32_t { kLine = 4, kSpheres = 7 };
  Kind kind = Kind::kLine;
  std::string name;  ///< of the group; with the number it replaces the same one of before
  std::int32_t number = 0;
  float red = 0.0F;
  float green = 0.0F;
  float blue = 0.0F;
  double size_m = 0.0;  ///< a line's width, a sphere's diameter
  std::vector<Place> places;
};
void write_drawings(CdrWriter& writer, std::int64_t stamp_ns, std::span<const Drawing> drawings);

}  // namespace vigil::recording
