#include "vigil/adapters/console/density_picture.hpp"

#include "vigil/core/field/density.hpp"
#include "vigil/runtime/grid_of.hpp"
#include "vigil/runtime/mission_setup.hpp"

namespace vigil::console {

std::string density_picture(const runtime::Mission& mission, Eigen::Index cells, const DensityContext& context) {
  const field::Field field = runtime::monitored_field(mission);
  const field::GridShape shape = runtime::grid_of(field, cells);
  return density_frame(field, field::rasterise(field, runtime::importance(mission), shape), context);
}

}  // namespace vigil::console
