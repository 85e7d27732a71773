#pragma once

#include <cstdint>

#include "vigil/adapters/recording/bag_recorder.hpp"

namespace vigil::apps {

/// How a flight is recorded, as the command line says it.
struct RecordingOptions {
  std::uint64_t keep_every = 1;       ///< every Nth tick
  std::uint64_t split_mib = 2048;     ///< a new file is begun when one has grown to this; 0: never
  std::uint64_t keep_free_mib = 256;  ///< on the disk
};

/// For the recorder of a simulated flight.
[[nodiscard]] inline recording::BagRecorderOptions recorder_options(const RecordingOptions& options) {
  recording::BagRecorderOptions result;
  result.keep_every = options.keep_every;
  result.bag.split_bytes = options.split_mib << 20U;
  result.bag.keep_free_bytes = options.keep_free_mib << 20U;
  return result;
}

}  // namespace vigil::apps
