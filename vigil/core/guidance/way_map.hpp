#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "vigil/core/field/field.hpp"
#include "vigil/core/field/polygon.hpp"

namespace vigil::guidance {

/// What a way has to keep clear of. Metres, field frame.
struct WayParameters {
  field::Field field;
  double wall_distance_m = 0.0;  ///< no way comes closer to a wall
  double clearance_m = 0.0;      ///< ... or to an edge of a no-fly polygon, but for its two ends
  std::size_t most_edges = 0;
};

/// The shortest way from one place to another.
struct Way {
  double length_m = 0.0;
  Vec2 next = Vec2::Zero();  ///< where to fly straight to first
};

/// The shortest ways round no-fly polygons. A shortest way is straight but where it bends round a convex corner, so
/// that the corners, moved out by the clearance, and what sees what among them, are all there is to know: exact up to
/// the rounding of corners by tangents (at most 60 degrees each, 15 % of the clearance, and 5 % that corners are
/// farther out), on no grid. Where there are more than kMostCorners the sharpest are kept: ways are as clear, but may
/// be longer.
///
/// The map is made piece by piece: begin(), then work() until is_ready(), as much at a time as there is time for. A
/// value: a copy goes on like its original. Allocates when it is constructed, and never again, but
/// for a copy in its first begin(). One thread at a time.
class WayMap {
 public:
  static constexpr std::size_t kMostCorners = 128;

  explicit WayMap(const WayParameters& parameters);

  /// Another ground. `no_fly`: as field::edges() gives them, polygon after polygon, at most most_edges; those beyond
  /// are passed over. Edges that do not close are taken for what they are, lines.
  void begin(std::span<const field::Segment> no_fly) noexcept;

  /// Goes on making the map for about so many looks, of a line at an edge: some nanoseconds each. At least one step.
  void work(std::size_t looks) noexcept;

  [[nodiscard]] bool is_ready() const noexcept { return step_ == Step::kReady; }

  /// Whether the straight line keeps the clearance from all edges; where one of its ends is closer to an edge than
  /// that, it comes no closer to any. False for what is not finite.
  [[nodiscard]] bool sees(const Vec2& from, const Vec2& to) const noexcept;

  /// None where no way is known: from or to is inside of a polygon, or shut in, or the map is not ready and the
  /// straight way not free. Looks at most 2 corners + 7 times at every edge.
  [[nodiscard]] std::optional<Way> way(const Vec2& from, const Vec2& to) noexcept;

  /// The most looks that way() takes.
  [[nodiscard]] std::size_t looks_of_a_way() const noexcept { return (2 * corners_.size() + 7) * edges_.size(); }

  [[nodiscard]] std::span<const Vec2> corners() const noexcept { return corners_; }

 private:
  enum class Step { kSeeing, kJoining, kReady };

  struct Corner {
    Vec2 place = Vec2::Zero();
    double turn_rad = 0.0;
    double share = 0.0;  ///< decides among equal turns: those that are kept lie all round
  };

  void find_corners() noexcept;
  void add_corners(const Vec2& vertex, const Vec2& before, const Vec2& after) noexcept;
  [[nodiscard]] bool is_open(const Vec2& place) const noexcept;
  [[nodiscard]] double distance_to_edges(const Vec2& place) const noexcept;
  /// The clearance, or less where the place has less itself.
  [[nodiscard]] double clearance_at(const Vec2& place) const noexcept;
  [[nodiscard]] bool is_free(const field::Segment& line, double clearance_m) const noexcept;
  void see_next() noexcept;
  void join_next() noexcept;
  void look_around(const Vec2& from, std::span<double> lengths) const noexcept;
  double& length(std::size_t i, std::size_t j) noexcept { return lengths_[i * corners_.size() + j]; }

  WayParameters parameters_;
  std::vector<field::Segment> edges_;
  std::vector<Corner> candidates_;
  std::vector<Vec2> corners_;
  std::vector<double> lengths_;  ///< corners x corners; infinity: no way known
  Step step_ = Step::kReady;
  std::size_t row_ = 0;
  std::size_t column_ = 0;
  std::vector<double> from_;  ///< work space: from one place to every corner
  std::vector<double> to_;
};

}  // namespace vigil::guidance
