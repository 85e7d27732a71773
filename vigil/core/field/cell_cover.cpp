#include "vigil/core/field/cell_cover.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::field {
namespace {

// Cuts a segment where one of its coordinates is 0, 1, ..., count and hands over the pieces in order.
template <typename Visit>
void cut_at_integers(const Segment& segment, Eigen::Index axis, Eigen::Index count, const Visit& visit) {
  const double begin = segment.a[axis];
  const double end = segment.b[axis];
  const double last = static_cast<double>(count);
  const double step = begin < end ? 1.0 : -1.0;
  const double first = begin < end ? std::max(0.0, std::floor(begin) + 1.0) : std::min(last, std::ceil(begin) - 1.0);
  Vec2 from = segment.a;
  for (double line = first; (end - line) * step > 0.0 && line >= 0.0 && line <= last; line += step) {
    Vec2 to = segment.a + (line - begin) / (end - begin) * (segment.b - segment.a);
    to[axis] = line;
    visit(Segment{from, to});
    from = to;
  }
  visit(Segment{from, segment.b});
}

Eigen::Index cell_of(double coordinate, Eigen::Index count) {
  return static_cast<Eigen::Index>(std::clamp(std::floor(coordinate), -1.0, static_cast<double>(count)));
}

// By Green's theorem the part of a cell that lies inside a counter-clockwise outline has the area
//
//   closed integral of (clamp(x, left, right) - left) dy     over the outline's pieces within the cell's row:
//
// a piece in the cell itself counts by its mean distance from the cell's left side, a piece further right by the full
// width, one further left not at all. Lengths are in cells here.
class Cover {
 public:
  explicit Cover(GridShape shape)
      : own_(Eigen::ArrayXXd::Zero(shape.nx, shape.ny)), to_the_left_(Eigen::ArrayXXd::Zero(shape.nx, shape.ny)) {}

  void add(const Segment& edge) {
    cut_at_integers(edge, 1, own_.cols(), [this](const Segment& in_a_row) {
      cut_at_integers(in_a_row, 0, own_.rows(), [this](const Segment& in_a_cell) { add_piece(in_a_cell); });
    });
  }

  [[nodiscard]] Eigen::ArrayXXd share() const {
    Eigen::ArrayXXd share = own_;
    for (Eigen::Index iy = 0; iy < share.cols(); ++iy) {
      double full_width = 0.0;
      for (Eigen::Index ix = share.rows(); ix-- > 0;) {
        full_width += to_the_left_(ix, iy);
        share(ix, iy) = snapped(share(ix, iy) + full_width);
      }
    }
    return share;
  }

 private:
  void add_piece(const Segment& piece) {
    const Vec2 middle = 0.5 * (piece.a + piece.b);
    const double rise = piece.b.y() - piece.a.y();
    const Eigen::Index ix = cell_of(middle.x(), own_.rows());
    const Eigen::Index iy = cell_of(middle.y(), own_.cols());
    if (iy < 0 || iy >= own_.cols() || ix < 0) return;
    if (ix < own_.rows()) own_(ix, iy) += rise * (middle.x() - static_cast<double>(ix));
    if (ix > 0) to_the_left_(ix - 1, iy) += rise;
  }

  // Rounding must leave neither a trace of attention in a forbidden cell nor a negative share.
  static double snapped(double share) {
    constexpr double kRounding = 1e-9;
    if (share < kRounding) return 0.0;
    return share > 1.0 - kRounding ? 1.0 : share;
  }

  Eigen::ArrayXXd own_;
  Eigen::ArrayXXd to_the_left_;  // what all cells up to this one get
};

}  // namespace

Eigen::ArrayXXd covered_share(const Polygon& polygon, const Field& field, GridShape shape) {
  const Vec2 cells_per_metre(static_cast<double>(shape.nx) / field.length_x,
                             static_cast<double>(shape.ny) / field.length_y);
  Cover cover(shape);
  for (const Segment& edge : edges(polygon)) {
    cover.add({edge.a.cwiseProduct(cells_per_metre), edge.b.cwiseProduct(cells_per_metre)});
  }
  return cover.share();
}

}  // namespace vigil::field
