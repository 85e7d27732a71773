#include "vigil/adapters/recording/message_definitions.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <vector>

#include "vigil/adapters/recording/own_definitions.hpp"

namespace vigil::recording {
namespace {

// What ROS 2 (Humble and later) calls these fields, in its order: without that, nobody else could read them.
constexpr std::array kStandard{
    Definition{"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
    Definition{"builtin_interfaces/Duration", "int32 sec\nuint32 nanosec\n"},
    Definition{"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
    Definition{"std_msgs/Float64", "float64 data\n"},
    Definition{"std_msgs/ColorRGBA", "float32 r\nfloat32 g\nfloat32 b\nfloat32 a\n"},
    Definition{"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
    Definition{"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
    Definition{"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
    Definition{"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
    Definition{"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
    Definition{"geometry_msgs/TwistStamped", "std_msgs/Header header\ngeometry_msgs/Twist twist\n"},
    Definition{"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
    Definition{"nav_msgs/MapMetaData",
               "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
               "geometry_msgs/Pose origin\n"},
    Definition{"nav_msgs/OccupancyGrid", "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"},
    Definition{"diagnostic_msgs/KeyValue", "string key\nstring value\n"},
    Definition{"diagnostic_msgs/DiagnosticStatus",
               "byte OK=0\nbyte WARN=1\nbyte ERROR=2\nbyte STALE=3\nbyte level\nstring name\nstring message\n"
               "string hardware_id\ndiagnostic_msgs/KeyValue[] values\n"},
    Definition{"diagnostic_msgs/DiagnosticArray",
               "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n"},
    Definition{"sensor_msgs/CompressedImage", "std_msgs/Header header\nstring format\nuint8[] data\n"},
    Definition{"visualization_msgs/UVCoordinate", "float32 u\nfloat32 v\n"},
    Definition{"visualization_msgs/MeshFile", "string filename\nuint8[] data\n"},
    Definition{"visualization_msgs/Marker",
               "int32 ARROW=0\nint32 CUBE=1\nint32 SPHERE=2\nint32 CYLINDER=3\nint32 LINE_STRIP=4\nint32 LINE_LIST=5\n"
               "int32 CUBE_LIST=6\nint32 SPHERE_LIST=7\nint32 POINTS=8\nint32 TEXT_VIEW_FACING=9\n"
               "int32 MESH_RESOURCE=10\nint32 TRIANGLE_LIST=11\nint32 ADD=0\nint32 MODIFY=0\nint32 DELETE=2\n"
               "int32 DELETEALL=3\nstd_msgs/Header header\nstring ns\nint32 id\nint32 type\nint32 action\n"
               "geometry_msgs/Pose pose\ngeometry_msgs/Vector3 scale\nstd_msgs/ColorRGBA color\n"
               "builtin_interfaces/Duration lifetime\nbool frame_locked\ngeometry_msgs/Point[] points\n"
               "std_msgs/ColorRGBA[] colors\nstring texture_resource\nsensor_msgs/CompressedImage texture\n"
               "visualization_msgs/UVCoordinate[] uv_coordinates\nstring text\nstring mesh_resource\n"
               "visualization_msgs/MeshFile mesh_file\nbool mesh_use_embedded_materials\n"},
    Definition{"visualization_msgs/MarkerArray", "visualization_msgs/Marker[] markers\n"},
};

const Definition* find(std::span<const Definition> definitions, std::string_view type) {
  const auto found = std::ranges::find(definitions, type, &Definition::type);
  return found == definitions.end() ? nullptr : &*found;
}

const Definition& definition_of(std::string_view type) {
  const Definition* own = find(own_definitions(), type);
  const Definition* found = own != nullptr ? own : find(kStandard, type);
  assert(found != nullptr);
  return *found;
}

/// "vigil_msgs/msg/Tick" as "vigil_msgs/Tick".
std::string short_name(std::string_view type) {
  constexpr std::string_view kMiddle = "/msg/";
  const std::size_t at = type.find(kMiddle);
  return std::string(type.substr(0, at)) + "/" + std::string(type.substr(at + kMiddle.size()));
}

/// The types that a field's line names may be of another package, or of its own without saying so.
std::string type_in(std::string_view line, std::string_view package) {
  const std::string_view word = line.substr(0, line.find_first_of(" [#"));
  if (word.find('/') != std::string_view::npos) return std::string(word);
  const bool is_named = !word.empty() && word.front() >= 'A' && word.front() <= 'Z';
  return is_named ? std::string(package) + "/" + std::string(word) : std::string();
}

void add_types(const Definition& definition, std::vector<std::string_view>& types) {
  const std::string_view package = definition.type.substr(0, definition.type.find('/'));
  for (std::string_view rest = definition.text; !rest.empty();) {
    const std::size_t end = rest.find('\n');
    const std::string type = type_in(rest.substr(0, end), package);
    rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    if (type.empty()) continue;
    const Definition& needed = definition_of(type);
    if (std::ranges::find(types, needed.type) != types.end()) continue;
    types.push_back(needed.type);
    add_types(needed, types);
  }
}

}  // namespace

std::string whole_definition(std::string_view type) {
  const Definition& definition = definition_of(short_name(type));
  std::vector<std::string_view> types;
  add_types(definition, types);
  std::string whole(definition.text);
  for (const std::string_view needed : types) {
    whole.append(80, '=').append("\nMSG: ").append(needed).append("\n");
    whole.append(definition_of(needed).text);
  }
  return whole;
}

}  // namespace vigil::recording
