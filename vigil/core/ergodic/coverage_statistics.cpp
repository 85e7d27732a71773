#include "vigil/core/ergodic/coverage_statistics.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace vigil::ergodic {
namespace {

// sum_k += weight times the sum over the drones of f_k(p_i). In portions, so that equal weights need no buffer of the
// swarm's size.
void add_evenly(Kernel& kernel, std::span<const Vec2> positions, double weight, Coefficients& sum_k) noexcept {
  constexpr std::size_t kPortion = Kernel::kPortion;
  std::array<double, kPortion> weights{};
  weights.fill(weight);
  for (std::size_t first = 0; first < positions.size(); first += kPortion) {
    const std::size_t size = std::min(kPortion, positions.size() - first);
    kernel.add_basis(positions.subspan(first, size), std::span(weights).first(size), sum_k);
  }
}

}  // namespace

CoverageStatistics::CoverageStatistics(const Basis& basis, Accounting accounting, std::optional<double> memory_s)
    : accounting_(accounting),
      memory_s_(memory_s),
      sum_(Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis())),
      past_averages_(Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis())) {
  assert(!memory_s || *memory_s > 0.0);
}

void CoverageStatistics::add(Kernel& kernel, std::span<const Vec2> positions, std::size_t active_set,
                             double dt_s) noexcept {
  const auto add_basis = [&](double weight, Coefficients& sum_k) { add_evenly(kernel, positions, weight, sum_k); };
  add_by(add_basis, positions.size(), active_set, dt_s);
}

bool CoverageStatistics::begin_sample(std::size_t drones, std::size_t active_set, double dt_s) noexcept {
  assert(dt_s > 0.0);
  if (accounting_ == Accounting::kPaperEq14 && (drones == 0 || active_set != active_set_)) end_phase();
  active_set_ = active_set;
  if (drones == 0) return false;

  const double kept_share = kept(dt_s);
  sum_ *= kept_share;
  time_s_ = time_s_ * kept_share + gain_s(dt_s, drones) * static_cast<double>(drones);
  has_samples_ = true;
  return true;
}

void CoverageStatistics::average(Coefficients& c_k) const noexcept {
  assert(c_k.rows() == sum_.rows() && c_k.cols() == sum_.cols());
  c_k = past_averages_;
  if (time_s_ > 0.0) c_k += sum_ / time_s_;
}

// dS = (f - S/memory) dt over dt_s with f held: S <- S exp(-dt/memory) + f memory (1 - exp(-dt/memory)); without memory
// S + f dt.
double CoverageStatistics::kept(double dt_s) const noexcept { return memory_s_ ? std::exp(-dt_s / *memory_s_) : 1.0; }

double CoverageStatistics::gain_s(double dt_s, std::size_t drones) const noexcept {
  const double gained_s = memory_s_ ? -*memory_s_ * std::expm1(-dt_s / *memory_s_) : dt_s;
  return accounting_ == Accounting::kElapsedTime ? gained_s / static_cast<double>(drones) : gained_s;
}

// With c_k = past + S/T: T (c_k - phi_k) = S - T (phi_k - past).
void CoverageStatistics::excess(const Coefficients& phi_k, Coefficients& d_k) const noexcept {
  d_k = sum_ - time_s_ * (phi_k - past_averages_);
}

void CoverageStatistics::foresee(Kernel& kernel, std::span<const Vec2> positions, const Coefficients& phi_k,
                                 double dt_s, Coefficients& d_k) const noexcept {
  assert(dt_s > 0.0 && !positions.empty());
  const double each_s = gain_s(dt_s, positions.size());
  d_k = kept(dt_s) * d_k - each_s * static_cast<double>(positions.size()) * (phi_k - past_averages_);
  add_evenly(kernel, positions, each_s, d_k);
}

void CoverageStatistics::reset() noexcept {
  sum_.setZero();
  time_s_ = 0.0;
  past_averages_.setZero();
  has_samples_ = false;
}

void CoverageStatistics::write(CoverageRecord& out) const {
  out.sum = sum_;
  out.time_s = time_s_;
  out.past_averages = past_averages_;
  out.has_samples = has_samples_;
}

bool CoverageStatistics::read(const CoverageRecord& record) {
  const auto fits = [this](const Coefficients& numbers) {
    return numbers.rows() == sum_.rows() && numbers.cols() == sum_.cols() && numbers.allFinite();
  };
  if (!fits(record.sum) || !fits(record.past_averages) || !std::isfinite(record.time_s) || record.time_s < 0.0)
    return false;
  sum_ = record.sum;
  time_s_ = record.time_s;
  past_averages_ = record.past_averages;
  has_samples_ = record.has_samples;
  return true;
}

// A phase without samples has no average and adds nothing.
void CoverageStatistics::end_phase() noexcept {
  if (time_s_ > 0.0) past_averages_ += sum_ / time_s_;
  sum_.setZero();
  time_s_ = 0.0;
}

}  // namespace vigil::ergodic
