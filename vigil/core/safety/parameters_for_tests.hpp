#pragma once

#include "vigil/core/safety/barrier.hpp"

namespace vigil::safety {

/// The numbers of the paper's experiment.
inline BarrierParameters paper() {
  BarrierParameters parameters;
  parameters.kind = BarrierKind::kPaper;
  parameters.separation_m = 0.2;
  parameters.contact_distance_m = 0.1;
  parameters.wall_distance_m = 0.17;
  parameters.no_fly_buffer_m = 0.1;
  parameters.u_max_m_s = 0.3;
  parameters.dt_s = 0.02;
  parameters.pair_gain = 10.0;
  parameters.wall_gain = 10.0;
  return parameters;
}

/// The same for vehicles with a lag, without any margin.
inline BarrierParameters lag_aware() {
  BarrierParameters parameters = paper();
  parameters.kind = BarrierKind::kLagAware;
  parameters.pair_gain = 5.0;
  parameters.wall_gain = 5.0;
  parameters.lag_s = 0.3;
  return parameters;
}

}  // namespace vigil::safety
