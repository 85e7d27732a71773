#include "vigil/adapters/mpi/mpi_team.hpp"

namespace vigil::mpi {

std::unique_ptr<runtime::CampaignTeam> join_team() {
  throw MpiError(
      "--mpi: this program was built without MPI; install libopenmpi-dev and openmpi-bin and build it again");
}

}  // namespace vigil::mpi
