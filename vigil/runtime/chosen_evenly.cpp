#include "vigil/runtime/chosen_evenly.hpp"

#include <algorithm>
#include <random>

namespace vigil::runtime {

std::vector<std::size_t> chosen_evenly(std::size_t count, std::size_t most) {
  const std::size_t stretches = std::min(count, most);
  // One of each of equal stretches, anywhere in it: always the first would be one column of a grid whose rows are as
  // long as a stretch, and any regular step shows as a pattern in some grid.
  std::minstd_rand random;
  std::vector<std::size_t> chosen;
  chosen.reserve(stretches);
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t first = count * k / stretches;
    const std::size_t length = count * (k + 1) / stretches - first;
    chosen.push_back(first + random() % length);
  }
  return chosen;
}

}  // namespace vigil::runtime
