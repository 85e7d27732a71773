#include "vigil/swarm/protection.hpp"

#include <algorithm>

namespace vigil::swarm {

Protection::Protection(const ergodic::Basis& basis)
    : phi_k_(ergodic::Coefficients::Zero(basis.indices_per_axis(), basis.indices_per_axis())),
      protected_k_(phi_k_),
      asked_k_(phi_k_) {}

void Protection::retarget(const ergodic::Coefficients& phi_k, const ergodic::Coefficients& protected_k) noexcept {
  phi_k_ = phi_k;
  const bool has_targets = phi_k(0, 0) > 0.0;
  if (has_targets && protected_k.size() == phi_k.size())
    protected_k_ = protected_k;
  else
    protected_k_.setZero();
  // f_00 is constant: its coefficient is a density's integral, but for a factor
  share_.usual = has_targets ? std::clamp(protected_k_(0, 0) / phi_k_(0, 0), 0.0, 1.0) : 0.0;
  share_.now = share_with(shortage_);
  asked_share_ = share_.usual;
  mix();
}

void Protection::start_afresh() noexcept {
  asked_share_ = share_.now;
  mix();
}

double Protection::share_with(double shortage) const noexcept {
  return std::min(share_.usual * shortage, std::max(share_.usual, kMost));
}

void Protection::follow(std::size_t active, std::size_t drones, double dt_s, double remembered) noexcept {
  if (active == 0) return;
  const double wanted = std::max(1.0, static_cast<double>(drones) / static_cast<double>(active));
  shortage_ += (wanted - shortage_) * dt_s / (kFollowsInS + dt_s);
  if (share_.usual == 0.0) return;
  share_.now = share_with(shortage_);
  const double before = asked_share_;
  asked_share_ += (share_.now - asked_share_) * std::clamp(remembered, 0.0, 1.0);
  if (asked_share_ != before) mix();
}

void Protection::mix() noexcept {
  const ProtectedShare asked{share_.usual, asked_share_};
  if (asked.now == asked.usual)
    asked_k_ = phi_k_;
  else
    asked_k_ = asked.factor() * protected_k_ + asked.rest_factor() * (phi_k_ - protected_k_);
}

}  // namespace vigil::swarm
