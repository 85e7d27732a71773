#include "vigil/runtime/lateness.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vigil::runtime {
namespace {

constexpr double kBinsAnOctave = 32.0;

}  // namespace

void Lateness::add(std::chrono::nanoseconds late) noexcept {
  const double us = std::max(0.0, std::chrono::duration<double, std::micro>(late).count());
  const double bin = us <= 1.0 ? 0.0 : std::ceil(kBinsAnOctave * std::log2(us));
  ++bins_[std::min(static_cast<std::size_t>(bin), bins_.size() - 1)];
  ++count_;
  max_us_ = std::max(max_us_, us);
}

void Lateness::add(const Lateness& others) noexcept {
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) bins_[bin] += others.bins_[bin];
  count_ += others.count_;
  max_us_ = std::max(max_us_, others.max_us_);
}

double Lateness::quantile_us(double share) const noexcept {
  const auto wanted = static_cast<std::uint64_t>(std::ceil(share * static_cast<double>(count_)));
  std::uint64_t seen = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    seen += bins_[bin];
    if (seen >= wanted) return std::min(max_us_, std::exp2(static_cast<double>(bin) / kBinsAnOctave));
  }
  return max_us_;
}

LatenessFigures Lateness::figures() const noexcept {
  if (count_ == 0) return {};
  return {.ticks = count_,
          .p50_us = quantile_us(0.5),
          .p99_us = quantile_us(0.99),
          .p999_us = quantile_us(0.999),
          .max_us = max_us_};
}

}  // namespace vigil::runtime
