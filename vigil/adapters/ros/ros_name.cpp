#include "vigil/adapters/ros/ros_name.hpp"

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

std::string vicon_topic(const std::string& id) {
  const std::string name = ros_name(id);
  return "/vicon/" + name + "/" + name;
}

}  // namespace vigil::ros_bridge
