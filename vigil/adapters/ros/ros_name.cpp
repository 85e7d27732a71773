#include "vigil/adapters/ros/ros_name.hpp"

#include <map>

namespace vigil::ros_bridge {
namespace {

// Not those of <cctype>, which depend on the locale.
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

std::string last_part(const std::string& name) {
  const std::size_t slash = name.rfind('/');
  return slash == std::string::npos ? name : name.substr(slash + 1);
}

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

std::string complaint_of_frames(const std::string& id, const std::string& frame, const std::string& child) {
  const std::string of = last_part(child);
  if (last_part(frame) != "world")
    return "positions are in frame \"" + frame + "\" instead of \"world\"; set the tracker's reference frame to world";
  if (of != id && of != ros_name(id))
    return "positions on its topic are of \"" + child +
           "\"; give the subject in the tracker, and its segment, the drone's name";
  return {};
}

std::string vicon_topic(const std::string& id) {
  const std::string name = ros_name(id);
  return "/vicon/" + name + "/" + name;
}

}  // namespace vigil::ros_bridge
