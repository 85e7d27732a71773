#pragma once

#include <cstddef>

#include "vigil/core/ergodic/basis.hpp"

namespace vigil::swarm {

/// How much of all attention goes to the protected parts of a target, in [0, 1].
struct ProtectedShare {
  double usual = 0.0;  ///< as the target says it; 0: nothing is protected
  double now = 0.0;    ///< with the drones that there are

  /// By what the density of the protected parts, and of the rest, is to be multiplied.
  [[nodiscard]] double factor() const noexcept { return usual > 0.0 ? now / usual : 1.0; }
  [[nodiscard]] double rest_factor() const noexcept { return usual < 1.0 ? (1.0 - now) / (1.0 - usual) : 1.0; }
};

/// What is asked for with fewer drones than a mission has. As long as nothing is protected every part suffers in
/// proportion to its weight. Protected parts keep the drones that they would have with all of them: their share of the
/// attention grows as drones become fewer, up to kMost, and the rest shares what is left in proportion. The share
/// follows the number of drones with a time constant of kFollowsInS.
///
/// What the past is held against is what was asked for then, averaged as coverage is: otherwise all drones would first
/// make up for the time when the protected part got its usual share, and leave the rest alone for many minutes. So the
/// metric does not jump either. A value; allocates where it is constructed.
class Protection {
 public:
  explicit Protection(const ergodic::Basis& basis);

  /// Another target, against which all of the past is held, with its usual shares: its coefficients, and those of its
  /// protected part; of no size where nothing is protected. Precondition: of the basis' shape, finite.
  void retarget(const ergodic::Coefficients& phi_k, const ergodic::Coefficients& protected_k) noexcept;
  /// A tick of dt_s with so many drones that cover, of those that the mission has, which makes up `remembered` of all
  /// coverage that is remembered, (0, 1]. Nothing changes where none covers.
  void follow(std::size_t active, std::size_t drones, double dt_s, double remembered) noexcept;
  /// The past is forgotten.
  void start_afresh() noexcept;

  /// What coverage is held against: coefficients of a density whose integral is that of the target.
  [[nodiscard]] const ergodic::Coefficients& asked_k() const noexcept { return asked_k_; }
  [[nodiscard]] const ProtectedShare& share() const noexcept { return share_; }

  static constexpr double kFollowsInS = 10.0;
  /// What is not protected is never forgotten altogether.
  static constexpr double kMost = 0.95;

 private:
  void mix() noexcept;
  [[nodiscard]] double share_with(double shortage) const noexcept;

  ergodic::Coefficients phi_k_;
  ergodic::Coefficients protected_k_;
  ergodic::Coefficients asked_k_;
  ProtectedShare share_;
  double asked_share_ = 0.0;  ///< share_.now as it is remembered
  double shortage_ = 1.0;     ///< the mission's drones over those that cover, as it is followed; >= 1
};

}  // namespace vigil::swarm
