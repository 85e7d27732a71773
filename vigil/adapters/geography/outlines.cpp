#include "vigil/adapters/geography/outlines.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/chrono.h>

#include "vigil/runtime/mission_setup.hpp"

namespace vigil::geography {
namespace {

/// Twice the area; negative where the corners go round clockwise.
double doubled_area(std::span<const Vec2> outline) {
  double sum = 0.0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2& a = outline[i];
    const Vec2& b = outline[(i + 1) % outline.size()];
    sum += a.x() * b.y() - b.x() * a.y();
  }
  return sum;
}

}  // namespace

std::vector<Vec2> closed_ring(std::span<const Vec2> outline) {
  std::vector<Vec2> ring(outline.begin(), outline.end());
  if (doubled_area(ring) < 0.0) std::ranges::reverse(ring);
  ring.push_back(ring.front());
  return ring;
}

std::vector<Vec2> field_outline(const runtime::Mission& mission) {
  const field::Field field = runtime::monitored_field(mission);
  const field::WorldFrame frame = runtime::world_frame(mission);
  return {frame.point_to_world({0.0, 0.0}), frame.point_to_world({field.length_x, 0.0}),
          frame.point_to_world({field.length_x, field.length_y}), frame.point_to_world({0.0, field.length_y})};
}

std::string time_of_day(std::int64_t began_ns, double time_s) {
  using std::chrono::milliseconds;
  constexpr std::int64_t kNanoPerMilli = 1'000'000;
  constexpr std::int64_t kMilliPerSecond = 1'000;
  const std::int64_t ms = began_ns / kNanoPerMilli + std::llround(time_s * 1e3);
  return fmt::format("{:%Y-%m-%dT%H:%M:%S}.{:03}Z", fmt::gmtime(static_cast<std::time_t>(ms / kMilliPerSecond)),
                     ms % kMilliPerSecond);
}

}  // namespace vigil::geography
