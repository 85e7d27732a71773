#include "vigil/swarm/energy.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::swarm {
namespace {

constexpr double kReportError = 0.03;        ///< share of full, standard deviation
constexpr double kReportErrorLastsS = 60.0;  ///< so long reports are wrong by the same
constexpr double kFarOff = 4.0;              ///< standard errors
constexpr double kFarOffForS = 10.0;
constexpr double kRateChange = 0.1;  ///< of itself, standard deviation ...
constexpr double kRateChangesInS = 300.0;
constexpr double kChargeDriftPerS = 0.005 * 0.005 / 60.0;  ///< variance; the report's curve is not the battery's
constexpr double kGroundDriftPerS = 3e-4;  ///< on the ground it is charged or changed, by nobody knows what
constexpr double kUnknownCharge = 0.1 * 0.1;

}  // namespace

EnergyEstimate::EnergyEstimate(double endurance_s) noexcept
    : rate_per_s_(std::clamp(1.0 / endurance_s, kSlowest, kFastest)) {
  constexpr double kUnsure = 0.3;
  rate_variance_ = kUnsure * kUnsure * rate_per_s_ * rate_per_s_;
}

void EnergyEstimate::predict(bool is_airborne, double dt_s) noexcept {
  if (!is_airborne) {
    charge_variance_ += kGroundDriftPerS * dt_s;
    covariance_ = 0.0;
    return;
  }
  charge_ -= rate_per_s_ * dt_s;
  charge_variance_ += dt_s * (dt_s * rate_variance_ - 2.0 * covariance_ + kChargeDriftPerS);
  covariance_ -= dt_s * rate_variance_;
  const double change = kRateChange * rate_per_s_;
  rate_variance_ += change * change / kRateChangesInS * dt_s;
}

void EnergyEstimate::correct(double reported, double dt_s) noexcept {
  const double off = reported - charge_;
  const double far_off = kFarOff * std::sqrt(charge_variance_ + kReportError * kReportError);
  far_off_s_ = std::abs(off) > far_off ? far_off_s_ + dt_s : 0.0;
  if (far_off_s_ > kFarOffForS) {
    charge_ = reported;
    charge_variance_ = kUnknownCharge;
    covariance_ = 0.0;
    far_off_s_ = 0.0;
    return;
  }
  // White noise with as much of it at low frequencies as an error that lasts.
  const double noise = kReportError * kReportError * std::max(1.0, kReportErrorLastsS / dt_s);
  const double sum = charge_variance_ + noise;
  const double innovation = std::clamp(off, -far_off, far_off);
  charge_ += charge_variance_ / sum * innovation;
  rate_per_s_ += covariance_ / sum * innovation;
  rate_variance_ -= covariance_ * covariance_ / sum;
  covariance_ *= noise / sum;
  charge_variance_ *= noise / sum;
}

void EnergyEstimate::stay_in_bounds() noexcept {
  charge_ = std::clamp(charge_, 0.0, 1.0);
  rate_per_s_ = std::clamp(rate_per_s_, kSlowest, kFastest);
  charge_variance_ = std::clamp(charge_variance_, 0.0, 1.0);
  rate_variance_ = std::clamp(rate_variance_, 0.0, kFastest * kFastest);
  const double most = std::sqrt(charge_variance_ * rate_variance_);
  covariance_ = std::clamp(covariance_, -most, most);
}

void EnergyEstimate::update(double reported, bool is_airborne, double dt_s) noexcept {
  const bool is_reported = std::isfinite(reported);
  const double share = is_reported ? std::clamp(reported, 0.0, 1.0) : 0.0;
  if (!is_known_) {
    if (!is_reported) return;
    is_known_ = true;
    charge_ = share;
    charge_variance_ = kReportError * kReportError;
    return;
  }
  predict(is_airborne, dt_s);
  if (is_reported) correct(share, dt_s);
  stay_in_bounds();
}

std::optional<TimeLeft> EnergyEstimate::time_to(double reserve) const noexcept {
  if (!is_known_) return std::nullopt;
  // t = (charge - reserve) / rate; its variance to first order.
  const double t = std::max(0.0, charge_ - reserve) / rate_per_s_;
  const double variance = charge_variance_ - 2.0 * t * covariance_ + t * t * rate_variance_;
  const double error_s = std::sqrt(std::max(0.0, variance)) / rate_per_s_;
  return TimeLeft{.s = t, .least_s = std::max(0.0, t - 2.0 * error_s)};
}

}  // namespace vigil::swarm
