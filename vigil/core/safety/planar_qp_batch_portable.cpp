// The planar solver's batches for any processor.

#include "vigil/core/safety/planar_qp_lanes.hpp"

namespace vigil::safety {
namespace {

constexpr std::size_t kLanes = PlanarQpColumns::kLanes;

struct EightMarks {
  static EightMarks all() { return {0xff}; }
  std::uint8_t lanes;
};

EightMarks operator&(EightMarks a, EightMarks b) { return {static_cast<std::uint8_t>(a.lanes & b.lanes)}; }
EightMarks operator|(EightMarks a, EightMarks b) { return {static_cast<std::uint8_t>(a.lanes | b.lanes)}; }
EightMarks without(EightMarks a, EightMarks b) { return {static_cast<std::uint8_t>(a.lanes & ~b.lanes)}; }
bool any(EightMarks a) { return a.lanes != 0; }
std::uint8_t bits(EightMarks a) { return a.lanes; }

struct EightNumbers {
  using Marks = EightMarks;
  template <typename Of>
  static EightNumbers of(const Of& lane) {
    EightNumbers result;
    for (std::size_t i = 0; i < kLanes; ++i) result.lanes[i] = lane(i);
    return result;
  }
  static EightNumbers all(double number) {
    return of([&](std::size_t) { return number; });
  }
  static EightNumbers load(const double* from) {
    return of([&](std::size_t i) { return from[i]; });
  }
  void store(double* to) const {
    for (std::size_t i = 0; i < kLanes; ++i) to[i] = lanes[i];
  }
  double lanes[kLanes];
};

EightNumbers operator+(const EightNumbers& a, const EightNumbers& b) {
  return EightNumbers::of([&](std::size_t i) { return a.lanes[i] + b.lanes[i]; });
}
EightNumbers operator-(const EightNumbers& a, const EightNumbers& b) {
  return EightNumbers::of([&](std::size_t i) { return a.lanes[i] - b.lanes[i]; });
}
EightNumbers operator*(const EightNumbers& a, const EightNumbers& b) {
  return EightNumbers::of([&](std::size_t i) { return a.lanes[i] * b.lanes[i]; });
}
EightNumbers operator/(const EightNumbers& a, const EightNumbers& b) {
  return EightNumbers::of([&](std::size_t i) { return a.lanes[i] / b.lanes[i]; });
}
EightNumbers operator-(const EightNumbers& a) {
  return EightNumbers::of([&](std::size_t i) { return -a.lanes[i]; });
}
EightNumbers magnitude(const EightNumbers& a) {
  return EightNumbers::of([&](std::size_t i) { return __builtin_fabs(a.lanes[i]); });
}
EightNumbers root(const EightNumbers& a) {
  return EightNumbers::of([&](std::size_t i) { return __builtin_sqrt(a.lanes[i]); });
}
EightMarks is_less(const EightNumbers& a, const EightNumbers& b) {
  unsigned lanes = 0;
  for (std::size_t i = 0; i < kLanes; ++i) lanes |= (a.lanes[i] < b.lanes[i] ? 1u : 0u) << i;
  return {static_cast<std::uint8_t>(lanes)};
}
EightMarks differ(const EightNumbers& a, const EightNumbers& b) {
  unsigned lanes = 0;
  for (std::size_t i = 0; i < kLanes; ++i) lanes |= (a.lanes[i] != b.lanes[i] ? 1u : 0u) << i;
  return {static_cast<std::uint8_t>(lanes)};
}
EightNumbers chosen(EightMarks which, const EightNumbers& a, const EightNumbers& b) {
  return EightNumbers::of([&](std::size_t i) { return ((which.lanes >> i) & 1u) != 0 ? a.lanes[i] : b.lanes[i]; });
}
/// b where one of them is not a number.
EightNumbers greatest(const EightNumbers& a, const EightNumbers& b) {
  return EightNumbers::of([&](std::size_t i) { return a.lanes[i] > b.lanes[i] ? a.lanes[i] : b.lanes[i]; });
}

}  // namespace

void solve_portable(PlanarQpColumns& problems, double radius) noexcept {
  LanesSolver<EightNumbers>::solve(problems, radius);
}

}  // namespace vigil::safety
