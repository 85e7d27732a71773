#pragma once

#include <optional>

namespace vigil::swarm {

/// How long something may still go on.
struct TimeLeft {
  double s = 0.0;        ///< best guess, >= 0
  double least_s = 0.0;  ///< two standard errors less, >= 0
};

/// What is known of one drone's battery: its charge, and how fast flying empties it, learned from what the vehicle
/// reports. A Kalman filter of both,
///     charge' = -rate in the air, 0 on the ground;    rate' = 0, but for a tenth of itself in five minutes
/// whose measurement is the report. Reports are wrong by some 3 %, and stay so for a while (a voltage under load, a
/// curve that is not this battery's), so that many of them in a second say little more than one. One that is far off is
/// believed no more than one that is four standard errors off, until such have come for ten seconds on end: then the
/// battery is another one. Every report that is a number is taken for the nearest in [0, 1], no other for any. A value;
/// always finite.
class EnergyEstimate {
 public:
  EnergyEstimate() = default;
  /// A full battery is believed to fly so long, give or take a third. Precondition: > 0.
  explicit EnergyEstimate(double endurance_s) noexcept;

  /// dt_s later; `reported`: the share of full, NaN where none is. Precondition: dt_s > 0.
  void update(double reported, bool is_airborne, double dt_s) noexcept;

  /// False before the first report.
  [[nodiscard]] bool is_known() const noexcept { return is_known_; }
  /// Share of full, [0, 1].
  [[nodiscard]] double charge() const noexcept { return charge_; }
  /// Of full a second in the air; within [kSlowest, kFastest].
  [[nodiscard]] double rate_per_s() const noexcept { return rate_per_s_; }

  /// In the air, until the charge is down at `reserve`; none before the first report.
  [[nodiscard]] std::optional<TimeLeft> time_to(double reserve) const noexcept;

  static constexpr double kSlowest = 1.0 / 14'400.0;  ///< four hours
  static constexpr double kFastest = 1.0 / 60.0;

 private:
  void predict(bool is_airborne, double dt_s) noexcept;
  void correct(double reported, double dt_s) noexcept;
  void stay_in_bounds() noexcept;

  // Before anything is heard: a quarter of an hour, or not.
  static constexpr double kFirstRate = 1.0 / 900.0;

  double charge_ = 0.0;
  double rate_per_s_ = kFirstRate;
  double charge_variance_ = 0.0;
  double covariance_ = 0.0;
  double rate_variance_ = kFirstRate * kFirstRate;
  double far_off_s_ = 0.0;  ///< reports have been far off for so long
  bool is_known_ = false;
};

}  // namespace vigil::swarm
