#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "vigil/core/field/vec2.hpp"
#include "vigil/runtime/folder_lock.hpp"
#include "vigil/swarm/tick.hpp"

namespace vigil::runtime {

/// What a live flight leaves to a program that is started again: enough to go on with the same targets and coverage.
struct SavedFlight {
  std::string mission_text;  ///< as the mission was loaded, by mission_yaml()
  std::string targets_text;  ///< the same with the targets of the moment
  std::uint64_t revision = 1;
  swarm::SwarmPast past;
  std::vector<double> seen_s;  ///< of field::SeenMap
  struct Drone {
    Vec2 place_m = Vec2::Zero();  ///< field frame
    bool is_down = false;
    swarm::Intent order = swarm::Intent::kHold;  ///< that stood
  };
  std::vector<Drone> drones;  ///< in the mission's order
};

/// Says what is wrong with a state folder, and what to do.
class SavedFlightError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A folder with the newest SavedFlight, replaced as a whole and flushed to the disk, so that whenever the program or
/// the machine dies, one complete state is there. While it lives no other can be had of the same folder, here or in
/// another program.
class FlightStore {
 public:
  /// Makes the folder where it is not. Throws SavedFlightError, also where another program uses it.
  explicit FlightStore(std::filesystem::path folder);

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Nothing where nothing was saved. Throws SavedFlightError for a state that cannot be read or makes no sense.
  [[nodiscard]] std::optional<SavedFlight> load() const;
  /// Once it returns, no crash loses it. Throws SavedFlightError; what is there then is this or what was saved before.
  void save(const SavedFlight& flight) const;
  /// Forgets what was saved.
  void clear() const;

 private:
  std::filesystem::path folder_;
  std::optional<FolderLock> lock_;
};

/// As text, and back. saved_flight throws SavedFlightError.
[[nodiscard]] std::string saved_text(const SavedFlight& flight);
[[nodiscard]] SavedFlight saved_flight(const std::string& text);

}  // namespace vigil::runtime
