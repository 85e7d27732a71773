#include "vigil/adapters/console/shown_drones.hpp"

#include "vigil/runtime/chosen_evenly.hpp"

namespace vigil::console {

ShownDrones::ShownDrones(std::size_t drones)
    : drones_(runtime::chosen_evenly(drones, kMost)), places_(drones, kNotShown) {
  for (std::size_t place = 0; place < drones_.size(); ++place)
    places_[drones_[place]] = static_cast<std::uint32_t>(place);
}

}  // namespace vigil::console
