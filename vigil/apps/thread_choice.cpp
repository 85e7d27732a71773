#include "vigil/apps/thread_choice.hpp"

#include <algorithm>
#include <thread>

#include "vigil/core/parallel/workers.hpp"

namespace vigil::apps {

std::size_t threads_for(std::size_t drones, std::size_t asked) {
  constexpr std::size_t kWorthAThread = 1000;
  if (asked > 0) return std::min(asked, parallel::kMostThreads);
  const std::size_t cores = std::max(1u, std::thread::hardware_concurrency());
  return std::clamp<std::size_t>(drones / kWorthAThread, 1, std::min(cores, parallel::kMostThreads));
}

}  // namespace vigil::apps
