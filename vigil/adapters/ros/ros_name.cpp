#include "vigil/adapters/ros/ros_name.hpp"

#include <map>

namespace vigil::ros_bridge {
namespace {

// Not those of <cctype>, which depend on the locale.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

}  // namespace

std::string ros_name(const std::string& id) {
  std::string name = id;
  for (char& c : name)
    if (!is_letter(c) && !is_digit(c)) c = '_';
  if (name.empty() || !is_letter(name.front())) name.insert(0, "d");
  return name;
}

std::string complaint_of_names(const std::vector<std::string>& ids) {
  std::map<std::string, std::string> owners;
  for (const std::string& id : ids) {
    const auto [owner, is_new] = owners.emplace(ros_name(id), id);
    if (!is_new)
      return "drones " + owner->second + " and " + id + " have the same ROS name, " + owner->first +
             "; ids must differ in letters and digits over ROS: rename one of them";
  }
  return {};
}

std::string vicon_topic(const std::string& id) {
  const std::string name = ros_name(id);
  return "/vicon/" + name + "/" + name;
}

}  // namespace vigil::ros_bridge
