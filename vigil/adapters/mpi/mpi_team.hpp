#pragma once

#include <memory>
#include <stdexcept>

#include "vigil/runtime/campaign_team.hpp"

namespace vigil::mpi {

/// This program was built without MPI, or MPI cannot start.
class MpiError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The processes that one `mpirun` started; a team of one where there was no mpirun. Once in a program. The team
/// outlives every use of it; it leaves MPI when it is destroyed after part(). Throws MpiError.
[[nodiscard]] std::unique_ptr<runtime::CampaignTeam> join_team();

}  // namespace vigil::mpi
