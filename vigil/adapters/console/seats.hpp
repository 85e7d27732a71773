#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "vigil/adapters/console/role.hpp"

namespace vigil::console {

/// At most so many connections at a time.
inline constexpr std::size_t kMostConnections = 256;

/// Somebody of this role comes in while fewer than so many are there who have said who they are. So viewers leave
/// places to operators, both leave places to safety pilots, and all of them to those who are about to say who they are
/// and to REST: whoever has one role's token in other hands locks out nobody above it.
[[nodiscard]] constexpr std::size_t places_for(Role role) {
  constexpr std::array<std::size_t, kRoleWords.size()> kPlaces{192, 208, 224};
  static_assert(kPlaces.back() < kMostConnections);
  return kPlaces[static_cast<std::size_t>(role)];
}

/// A connection, as far as its place is concerned.
class Guest {
 public:
  virtual ~Guest() = default;
  /// Where it comes from: an address, without a port.
  [[nodiscard]] virtual const std::string& origin() const = 0;
  /// Whether it has not said yet who it is.
  [[nodiscard]] virtual bool is_stranger() const = 0;
  /// Ends the connection; a second call does nothing.
  virtual void give_place() = 0;
};

/// How many may be connected at a time. Once all places are taken, the next comes in for a stranger, of the origin that
/// has most of them the one that came first: whoever opens connections in masses pushes out his own, and nobody who has
/// said who he is; those are fewer than all places (see places_for()). One thread.
class Seats {
 public:
  /// Precondition: most > 0.
  explicit Seats(std::size_t most) : most_(most) {}

  /// Whether there is a place for one more.
  [[nodiscard]] bool make_room();
  /// Its place is free again once it is destroyed.
  void seat(const std::shared_ptr<Guest>& guest);

 private:
  struct Place {
    std::weak_ptr<Guest> guest;
    bool is_asked_to_leave = false;
  };

  std::size_t most_;
  std::vector<Place> places_;  ///< in the order in which they were taken
};

}  // namespace vigil::console
