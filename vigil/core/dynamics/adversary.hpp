#pragma once

#include <cstddef>
#include <vector>

#include "vigil/core/dynamics/velocity_loop.hpp"

namespace vigil::dynamics {

/// Looks for the worst that commands |u| <= u_max can do to a loop that has limits, by dynamic programming backwards in
/// time over a grid of (v, a), bilinear in between. Commands change every 50 ms between five values from -u_max to
/// u_max, so that the answers may fall short of the supremum a little: by 0.3 % where it is known (a linear loop), by
/// 2 % against commands that change every 25 ms. Construction and questions allocate; answers are repeatable.
class Adversary {
 public:
  /// Precondition: an acceleration limit, no integral, no drag; u_max_m_s > 0.
  Adversary(const VelocityLoop& loop, double u_max_m_s);

  /// The greatest D of command_deviation(), dead time included. Precondition: leak_per_s > 0, tau_s >= 0.
  [[nodiscard]] double greatest_deviation(double tau_s, double leak_per_s) const;

  /// The greatest v from rest within five seconds, or held for ever.
  [[nodiscard]] double greatest_speed() const;

 private:
  /// What one command does to the state at one node within one period.
  struct Move {
    std::size_t corner;  ///< the node below the next state in v and a
    float along_v;       ///< how far the next state is beyond it, in cells
    float along_a;
    double distance_m;  ///< covered meanwhile
    double gained_m_s;  ///< change of v
  };

  [[nodiscard]] Move move_from(int v_node, int a_node, double command_m_s) const;
  [[nodiscard]] double after(const Move& move, const std::vector<double>& values) const;
  template <typename Payoff>
  void step_back(std::vector<double>& values, Payoff payoff) const;

  VelocityLoop loop_;
  double u_max_m_s_;
  double greatest_v_;
  double greatest_a_;
  std::vector<Move> moves_;  ///< for each node, one for each command
};

}  // namespace vigil::dynamics
