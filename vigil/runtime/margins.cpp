#include "vigil/runtime/margins.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>
#include <vector>

#include "vigil/runtime/adversarial_flight.hpp"

namespace vigil::runtime {
namespace {

constexpr double kGreatestGain = 5.0;    // 1/s: as fast as the filter leaves a broken barrier
constexpr double kBelievedSigmas = 3.0;  // or what is believed breaks R_s where margins contradict each other
constexpr double kReserve = 1.5;         // the search for the worst flight is no proof
constexpr double kLeastReserve = 0.15;   // of the way of a lag: nor does it find everything
constexpr double kBiasSigmas = 5.0;      // a bias takes a few values in a flight
constexpr double kNoiseSigmas = 6.0;     // noise many thousands
constexpr double kFlownGain = 1.25;      // flown so much more eagerly than they will be: just beyond may lie a cliff
constexpr double kBrakingShare = 0.8;
constexpr double kSlowing = 0.1;  // what a metre of slowing down weighs beside a metre of margin
constexpr double kGainStep = 0.65;
constexpr int kGainSteps = 7;
constexpr std::array kLagShares = {1.0, 1.4};
constexpr std::array kPeriods = {0.5, 1.5, 5.0};  // of the barrier's and the vehicle's times together
constexpr std::array kWallPeriods = {0.5, 1.5, 4.0, 10.0};
constexpr std::array kAngles = {0.4, 1.0, 1.4};

enum class Boundary { kPair, kWall };

/// How quickly a vehicle follows small changes of its command.
double nominal_lag(const dynamics::VelocityLoop& loop) {
  return dynamics::is_immediate(loop) ? 0.0 : 1.0 / (loop.proportional_per_s + loop.drag_per_s);
}

/// Whether v' = (u - v)/lag is all there is to the vehicle.
bool is_exact(const MarginProblem& problem) {
  const dynamics::VelocityLoop& loop = problem.loop;
  if (problem.given_lag_s && *problem.given_lag_s != nominal_lag(loop)) return false;
  const bool is_plain = loop.gain == 1.0 && loop.integral_per_s2 == 0.0 && loop.drag_per_s == 0.0 &&
                        loop.actuator_lag_s == 0.0 && dynamics::is_linear(loop);
  const double greatest_m_s2 = 2.0 * problem.u_max_m_s / nominal_lag(loop);
  return is_plain && (dynamics::is_immediate(loop) || !problem.acceleration_limit_m_s2 ||
                      *problem.acceleration_limit_m_s2 >= greatest_m_s2);
}

double longest_blindness_s(const MarginProblem& problem) {
  return problem.silence_s > 0.0 ? problem.silence_s + problem.observation_delay_s + problem.command_delay_s : 0.0;
}

/// A barrier asks for a braking of gain x u_max. Where a stop from u_max meets a limit of acceleration anyway, asking
/// for more than the limit means being later than asked.
double greatest_gain_by_braking(const MarginProblem& problem) {
  const double limit_m_s2 = std::min(problem.loop.acceleration_limit_m_s2,
                                     problem.acceleration_limit_m_s2.value_or(dynamics::VelocityLoop::kUnlimited));
  const bool is_limited = problem.u_max_m_s > limit_m_s2 * nominal_lag(problem.loop);
  return is_limited ? kBrakingShare * limit_m_s2 / problem.u_max_m_s : kGreatestGain;
}

/// A drone that goes on by an old order covers gain x h0 x L of the h0 that it had; of a pair the other one gives way
/// by its row meanwhile: h(t) = h0 (2 exp(-gain t) - 1).
double greatest_gain(const MarginProblem& problem, Boundary boundary) {
  const double blind_s = longest_blindness_s(problem);
  const double product = boundary == Boundary::kPair ? std::numbers::ln2 : 1.0;
  const double by_tick = 0.2 / problem.dt_s;
  return std::min(
      {kGreatestGain, by_tick, greatest_gain_by_braking(problem), blind_s > 0.0 ? product / blind_s : kGreatestGain});
}

/// Drones on a wide field; at walls, a narrow one.
AdversarialFlight flight_of(const MarginProblem& problem, Boundary boundary, double lag_s, double gain) {
  const double slowing_m = problem.u_max_m_s * (1.0 / gain + lag_s);
  const double side_m = (boundary == Boundary::kWall ? 4.0 : 10.0) * (problem.separation_m + slowing_m);
  const auto ticks = [&](double time_s) { return static_cast<std::size_t>(std::lround(time_s / problem.dt_s)); };
  AdversarialFlight flight;
  flight.loop = problem.loop;
  flight.acceleration_limit_m_s2 = problem.acceleration_limit_m_s2;
  safety::BarrierParameters& barrier = flight.barrier;
  barrier.separation_m = problem.separation_m;
  barrier.contact_distance_m = 0.5 * problem.separation_m;
  barrier.u_max_m_s = problem.u_max_m_s;
  barrier.dt_s = problem.dt_s;
  barrier.pair_gain = gain;
  barrier.wall_gain = gain;
  barrier.lag_s = lag_s;
  flight.field = {.length_x = side_m, .length_y = side_m};
  flight.start_radius_m = problem.separation_m + slowing_m;
  flight.observation_delay_ticks = ticks(problem.observation_delay_s);
  flight.command_delay_ticks = ticks(problem.command_delay_s);
  return flight;
}

/// Flights that differ in what is wished for.
class Attempts {
 public:
  explicit Attempts(const AdversarialFlight& plain) : plain_(plain) {}

  void add(Wish wish, double period_s, double angle_rad = 0.0, std::size_t drones = 2, std::uint64_t seed = 1) {
    AdversarialFlight flight = plain_;
    flight.wish = wish;
    flight.period_s = period_s;
    flight.angle_rad = angle_rad;
    flight.drones = drones;
    flight.seed = seed;
    flight.duration_s = 3.0 / plain_.barrier.pair_gain + 3.0 * period_s + 8.0 * plain_.barrier.lag_s;
    flights_.push_back(flight);
  }
  [[nodiscard]] const std::vector<AdversarialFlight>& flights() const { return flights_; }

 private:
  AdversarialFlight plain_;
  std::vector<AdversarialFlight> flights_;
};

/// Every way of wishing that is tried on each other.
Attempts attempts_on_each_other(const AdversarialFlight& plain, double time_s) {
  Attempts attempts(plain);
  attempts.add(Wish::kPress, time_s);
  for (const double angle : kAngles) attempts.add(Wish::kOrbit, time_s, angle);
  for (const double periods : kPeriods) {
    for (const Wish wish : {Wish::kPulse, Wish::kChase, Wish::kRandom}) attempts.add(wish, periods * time_s);
    for (const double angle : kAngles) attempts.add(Wish::kReverse, periods * time_s, angle);
    for (const std::uint64_t seed : {1U, 2U}) attempts.add(Wish::kRandom, periods * time_s, 0.0, 3, seed);
  }
  return attempts;
}

/// And on walls, alone and while others push.
Attempts attempts_on_walls(const AdversarialFlight& plain, double time_s) {
  Attempts attempts(plain);
  for (const double periods : kWallPeriods) {
    for (const double angle : {0.0, 0.6, 1.2}) attempts.add(Wish::kWalls, periods * time_s, angle, 1);
    for (const std::size_t drones : {2U, 3U}) attempts.add(Wish::kRandom, periods * time_s, 0.0, drones);
  }
  return attempts;
}

/// How far beyond the boundary the worst of them comes, without any margin.
double intrusion(const MarginProblem& problem, Boundary boundary, double lag_s, double gain) {
  const AdversarialFlight plain = flight_of(problem, boundary, lag_s, gain);
  const double time_s = lag_s + 0.5 / gain;
  const bool is_pair = boundary == Boundary::kPair;
  const Attempts attempts = is_pair ? attempts_on_each_other(plain, time_s) : attempts_on_walls(plain, time_s);
  double worst = 0.0;
  for (const AdversarialFlight& flight : attempts.flights()) {
    const Closest closest = fly(flight);
    worst = std::max(worst, is_pair ? problem.separation_m - closest.separation_m : -closest.wall_m);
  }
  return worst;
}

double model_margin(const MarginProblem& problem, Boundary boundary, double lag_s, double gain) {
  const double drones = boundary == Boundary::kPair ? 2.0 : 1.0;
  const double lag = std::max(lag_s, nominal_lag(problem.loop));
  return kReserve * intrusion(problem, boundary, lag_s, kFlownGain * gain) +
         kLeastReserve * drones * lag * problem.u_max_m_s;
}

struct Tuned {
  double gain = 0.0;
  double model_m = 0.0;
};

/// The gain that costs least at this boundary.
Tuned tune(const MarginProblem& problem, Boundary boundary, double lag_s) {
  Tuned best;
  double least = std::numeric_limits<double>::infinity();
  double gain = greatest_gain(problem, boundary);
  for (int step = 0; step < kGainSteps; ++step, gain *= kGainStep) {
    const double slowing_m = kSlowing * problem.u_max_m_s / gain;
    if (slowing_m >= least) break;
    const double model_m = model_margin(problem, boundary, lag_s, gain);
    if (model_m + slowing_m >= least) continue;
    least = model_m + slowing_m;
    best = {gain, model_m};
  }
  return best;
}

/// The lag that suits the vehicle best where two drones push each other round.
double tuned_lag(const MarginProblem& problem) {
  const double nominal = nominal_lag(problem.loop);
  if (problem.given_lag_s) return *problem.given_lag_s;
  if (is_exact(problem)) return nominal;
  const double gain = std::min(greatest_gain(problem, Boundary::kPair), 0.25 / nominal);
  double best = nominal;
  double least = std::numeric_limits<double>::infinity();
  for (const double share : kLagShares) {
    const double worst = intrusion(problem, Boundary::kPair, share * nominal, gain);
    if (worst >= least) continue;
    least = worst;
    best = share * nominal;
  }
  return best;
}

/// What is left of white or coloured noise of z behind a barrier that follows it at `rate`: first-order low passes.
double left_of_samples(double rate, double period_s) {
  const double product = std::min(1.0, rate * period_s);
  return std::sqrt(product / (2.0 - product));
}

MarginParts parts_of(const MarginProblem& problem, Boundary boundary, double lag_s, const Tuned& tuned) {
  const bool is_pair = boundary == Boundary::kPair;
  const double rate = is_pair ? 2.0 * tuned.gain : tuned.gain;  // both give way
  const double independent = is_pair ? std::numbers::sqrt2 : 1.0;
  const double together = is_pair ? 2.0 : 1.0;
  const double z_noise = std::hypot(problem.noise_m, lag_s * problem.velocity_noise_m_s);
  const double drift_m_s = lag_s * problem.push_m_s2;
  const double slow = rate * problem.push_time_s;
  MarginParts parts;
  parts.model_m = tuned.model_m;
  parts.delay_m = together * problem.u_max_m_s * problem.unsteady_delay_s;
  const double let_through = left_of_samples(rate, std::max(problem.dt_s, problem.measurement_period_s));
  parts.noise_m = independent * z_noise * std::max(kNoiseSigmas * let_through, kBelievedSigmas);
  parts.bias_m = kBiasSigmas * independent * problem.bias_m;
  parts.gusts_m = kBiasSigmas * independent * drift_m_s / rate * std::sqrt(slow / (1.0 + slow));
  parts.swaps_m = together * problem.u_max_m_s * problem.swap_s;
  return parts;
}

Tuned given_or_tuned(const MarginProblem& problem, Boundary boundary, double lag_s) {
  const std::optional<double>& given = boundary == Boundary::kPair ? problem.given_pair_gain : problem.given_wall_gain;
  if (is_exact(problem)) return {given.value_or(greatest_gain(problem, boundary)), 0.0};
  return given ? Tuned{*given, model_margin(problem, boundary, lag_s, *given)} : tune(problem, boundary, lag_s);
}

}  // namespace

Margins computed_margins(const MarginProblem& problem) {
  Margins margins;
  margins.lag_s = tuned_lag(problem);
  const Tuned pair = given_or_tuned(problem, Boundary::kPair, margins.lag_s);
  const Tuned wall = given_or_tuned(problem, Boundary::kWall, margins.lag_s);
  margins.pair_gain = pair.gain;
  margins.wall_gain = wall.gain;
  margins.pair = parts_of(problem, Boundary::kPair, margins.lag_s, pair);
  margins.wall = parts_of(problem, Boundary::kWall, margins.lag_s, wall);
  return margins;
}

Margins derive_margins(const MarginProblem& problem) {
  constexpr std::size_t kMostRemembered = 64;
  static std::mutex mutex;
  static std::vector<std::pair<MarginProblem, Margins>> remembered;
  const std::scoped_lock lock(mutex);
  const auto known = std::ranges::find(remembered, problem, &std::pair<MarginProblem, Margins>::first);
  if (known != remembered.end()) return known->second;
  if (remembered.size() == kMostRemembered) remembered.erase(remembered.begin());
  return remembered.emplace_back(problem, computed_margins(problem)).second;
}

}  // namespace vigil::runtime
