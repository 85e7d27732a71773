#pragma once

#include <cstddef>
#include <vector>

namespace vigil::runtime {

/// At most `most` of the numbers below `count`, ascending, spread over all of them: also over both directions of a grid
/// that was numbered row by row, whatever its width. Always the same ones.
[[nodiscard]] std::vector<std::size_t> chosen_evenly(std::size_t count, std::size_t most);

}  // namespace vigil::runtime
