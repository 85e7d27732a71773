#include "vigil/swarm/recharge_plan.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

namespace vigil::swarm {
namespace {

constexpr double kNever = std::numeric_limits<double>::infinity();

double latest_begin_s(const RechargeNeed& need) { return need.latest_leave_s + need.way_s; }

}  // namespace

RechargePlanner::RechargePlanner(std::size_t most_drones, std::size_t most_places) {
  order_.reserve(most_drones);
  taken_from_s_.reserve(most_places);
}

/// The latest moment at which it can begin at the place and be done before the next one there.
double RechargePlanner::begin_at(const RechargeNeed& need, std::size_t place) const noexcept {
  return std::min(latest_begin_s(need), taken_from_s_[place] - need.charge_s);
}

/// A place that will be free by then goes before one that will not; the first of equal ones.
std::size_t RechargePlanner::latest_place(const RechargeNeed& need, std::span<const double> free_at_s) const noexcept {
  std::size_t best = 0;
  for (std::size_t place = 1; place < free_at_s.size(); ++place) {
    const double lack = std::max(0.0, free_at_s[place] - begin_at(need, place));
    const double least = std::max(0.0, free_at_s[best] - begin_at(need, best));
    if (lack < least || (lack == least && begin_at(need, place) > begin_at(need, best))) best = place;
  }
  return best;
}

void RechargePlanner::plan(std::span<const RechargeNeed> needs, std::span<const double> free_at_s,
                           std::span<RechargeTurn> turns) noexcept {
  assert(needs.size() == turns.size() && !free_at_s.empty());
  order_.resize(needs.size());  // within its capacity
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::sort(order_.begin(), order_.end(), [&](std::size_t one, std::size_t other) {
    const double a = latest_begin_s(needs[one]);
    const double b = latest_begin_s(needs[other]);
    return a != b ? a > b : one < other;
  });
  taken_from_s_.assign(free_at_s.size(), kNever);
  for (const std::size_t drone : order_) {
    const RechargeNeed& need = needs[drone];
    const std::size_t place = latest_place(need, free_at_s);
    const double begin_s = begin_at(need, place);
    turns[drone] = {
        .leave_s = begin_s - need.way_s, .place = place, .too_soon_s = std::max(0.0, free_at_s[place] - begin_s)};
    taken_from_s_[place] = begin_s;
  }
}

}  // namespace vigil::swarm
