#pragma once

#include <functional>
#include <memory>
#include <mutex>

#include "vigil/runtime/shown_flight.hpp"

namespace vigil::apps {

/// Drones that fall where nobody flies them: they are landed before the program ends.
class FlownDrones {
 public:
  /// Those of the newest mission. Any thread.
  void watch(const std::shared_ptr<runtime::ShownFlight>& flight);

  /// Whether any drone of the newest mission is in the air, whoever flies it. Any thread.
  [[nodiscard]] bool are_in_the_air() const;

  /// Whether the program may end that has been asked to: once it neither lifts, flies nor lands any drone. To be asked
  /// some ten times a second until then: all are told to land. `tell` is called once, with the first order to land. One
  /// thread.
  [[nodiscard]] bool are_down(const std::function<void()>& tell);

 private:
  [[nodiscard]] std::shared_ptr<runtime::ShownFlight> newest() const;
  [[nodiscard]] bool any(bool (*predicate)(const swarm::DroneSnapshot&)) const;
  void land();

  mutable std::mutex mutex_;
  std::weak_ptr<runtime::ShownFlight> flight_;
  int asked_ = 0;
};

}  // namespace vigil::apps
