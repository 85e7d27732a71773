#include "vigil/adapters/console/seats.hpp"

#include <algorithm>
#include <map>

namespace vigil::console {

void Seats::seat(const std::shared_ptr<Guest>& guest) { places_.push_back({guest, false}); }

bool Seats::make_room() {
  std::erase_if(places_, [](const Place& place) { return place.guest.expired(); });
  const auto staying =
      std::count_if(places_.begin(), places_.end(), [](const Place& p) { return !p.is_asked_to_leave; });
  if (static_cast<std::size_t>(staying) < most_) return places_.size() < 2 * most_;

  std::map<std::string, std::vector<Place*>> strangers;
  for (Place& place : places_)
    if (const auto guest = place.guest.lock(); !place.is_asked_to_leave && guest->is_stranger())
      strangers[guest->origin()].push_back(&place);
  const auto crowd = std::max_element(strangers.begin(), strangers.end(),
                                      [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
  if (crowd == strangers.end()) return false;
  Place& place = *crowd->second.front();
  place.is_asked_to_leave = true;
  place.guest.lock()->give_place();
  return places_.size() < 2 * most_;
}

}  // namespace vigil::console
