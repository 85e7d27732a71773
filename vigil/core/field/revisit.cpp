#include "vigil/core/field/revisit.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace vigil::field {
namespace {

constexpr double kPlacesAcross = 8.0;

bool is_allowed(const Field& field, std::span<const Polygon> no_fly, const Vec2& p) {
  return field.contains(p) &&
         std::none_of(no_fly.begin(), no_fly.end(), [&](const Polygon& polygon) { return contains(polygon, p); });
}

/// The midpoints of kPlacesAcross squares across the longer side of a box that `is_inside` accepts.
template <typename IsInside>
std::vector<Vec2> sample_box(const Vec2& low, const Vec2& high, const IsInside& is_inside) {
  const double step = (high - low).maxCoeff() / kPlacesAcross;
  std::vector<Vec2> places;
  for (double y = low.y() + 0.5 * step; y < high.y(); y += step) {
    for (double x = low.x() + 0.5 * step; x < high.x(); x += step) {
      if (is_inside(Vec2(x, y))) places.emplace_back(x, y);
    }
  }
  return places;
}

}  // namespace

std::vector<Vec2> places_of(const Field& field, const Gaussian& gaussian, std::span<const Polygon> no_fly) {
  constexpr double kSigmas = 2.0;
  const Eigen::Matrix2d inverse = gaussian.covariance.inverse();
  const Vec2 reach = kSigmas * gaussian.covariance.diagonal().cwiseSqrt();
  std::vector<Vec2> places = sample_box(gaussian.mean - reach, gaussian.mean + reach, [&](const Vec2& p) {
    const Vec2 offset = p - gaussian.mean;
    return offset.dot(inverse * offset) <= kSigmas * kSigmas && is_allowed(field, no_fly, p);
  });
  if (places.empty()) places.push_back(field.clamp(gaussian.mean));
  return places;
}

std::vector<Vec2> places_of(const Field& field, const Polygon& outline, std::span<const Polygon> no_fly) {
  Vec2 low = outline.vertices.front();
  Vec2 high = low;
  Vec2 centre = Vec2::Zero();
  for (const Vec2& vertex : outline.vertices) {
    low = low.cwiseMin(vertex);
    high = high.cwiseMax(vertex);
    centre += vertex / static_cast<double>(outline.vertices.size());
  }
  std::vector<Vec2> places =
      sample_box(low, high, [&](const Vec2& p) { return contains(outline, p) && is_allowed(field, no_fly, p); });
  if (places.empty()) places.push_back(field.clamp(centre));
  return places;
}

RevisitLog::RevisitLog(std::string name, std::vector<Vec2> places, double created_s)
    : name_(std::move(name)), places_(std::move(places)), seen_s_(places_.size(), created_s) {}

void RevisitLog::see(std::span<const Vec2> positions, double radius_m, double now_s) noexcept {
  const double radius_squared = radius_m * radius_m;
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const bool is_seen = std::any_of(positions.begin(), positions.end(),
                                     [&](const Vec2& p) { return (p - places_[i]).squaredNorm() <= radius_squared; });
    if (!is_seen) continue;
    worst_gap_s_ = std::max(worst_gap_s_, now_s - seen_s_[i]);
    seen_s_[i] = now_s;
  }
}

void RevisitLog::watch(std::vector<Vec2> places, double now_s) {
  if (places == places_) return;
  worst_gap_s_ = worst_s(now_s);
  places_ = std::move(places);
  seen_s_.assign(places_.size(), now_s);
}

double RevisitLog::age_s(double now_s) const noexcept {
  const auto oldest = std::min_element(seen_s_.begin(), seen_s_.end());
  return oldest == seen_s_.end() ? 0.0 : now_s - *oldest;
}

double RevisitLog::worst_s(double now_s) const noexcept { return std::max(worst_gap_s_, age_s(now_s)); }

}  // namespace vigil::field
