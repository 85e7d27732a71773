#include "vigil/adapters/recording/standard_messages.hpp"

#include <algorithm>
#include <cmath>

namespace vigil::recording {
namespace {

constexpr std::string_view kFrame = "map";
constexpr std::size_t kHeaderBytes = 32;
constexpr std::size_t kPoseBytes = 64;
constexpr std::size_t kMarkerBytes = 512;

void put_time(CdrWriter& writer, std::int64_t stamp_ns) {
  constexpr std::int64_t kSecond = 1'000'000'000;
  writer.put(static_cast<std::int32_t>(stamp_ns / kSecond));
  writer.put(static_cast<std::uint32_t>(stamp_ns % kSecond));
}

void put_header(CdrWriter& writer, std::int64_t stamp_ns) {
  put_time(writer, stamp_ns);
  writer.put(kFrame);
}

void put_vector(CdrWriter& writer, double x, double y, double z) {
  for (const double value : {x, y, z}) writer.put(value);
}

void put_place(CdrWriter& writer, const Place& place) {
  put_vector(writer, place.position.x(), place.position.y(), place.height_m);
}

void put_pose(CdrWriter& writer, const Place& place, double yaw_rad = 0.0) {
  put_place(writer, place);
  put_vector(writer, 0.0, 0.0, std::sin(0.5 * yaw_rad));
  writer.put(std::cos(0.5 * yaw_rad));
}

void put_colour(CdrWriter& writer, const Drawing& drawing) {
  for (const float value : {drawing.red, drawing.green, drawing.blue, 1.0F}) writer.put(value);
}

/// What a marker has for textures and meshes: nothing.
void put_no_mesh(CdrWriter& writer, std::int64_t stamp_ns) {
  writer.put(std::string_view());  // texture_resource
  put_header(writer, stamp_ns);    // texture
  writer.put(std::string_view());
  writer.count(0);
  writer.count(0);                 // uv_coordinates
  writer.put(std::string_view());  // text
  writer.put(std::string_view());  // mesh_resource
  writer.put(std::string_view());  // mesh_file
  writer.count(0);
  writer.put(false);
}

void put_drawing(CdrWriter& writer, std::int64_t stamp_ns, const Drawing& drawing) {
  put_header(writer, stamp_ns);
  writer.put(std::string_view(drawing.name));
  writer.put(drawing.number);
  writer.put(static_cast<std::int32_t>(drawing.kind));
  writer.put(std::int32_t{0});  // add, or replace
  put_pose(writer, {});
  const bool is_line = drawing.kind == Drawing::Kind::kLine;
  put_vector(writer, drawing.size_m, is_line ? 0.0 : drawing.size_m, is_line ? 0.0 : drawing.size_m);
  put_colour(writer, drawing);
  writer.put(std::int32_t{0});  // lifetime: for ever
  writer.put(std::uint32_t{0});
  writer.put(false);
  writer.count(drawing.places.size());
  for (const Place& place : drawing.places) put_place(writer, place);
  writer.count(0);  // colours of each point
  put_no_mesh(writer, stamp_ns);
}

std::size_t bytes_of(const DroneDiagnosis& diagnosis) {
  std::size_t bytes = 64 + diagnosis.drone.size() * 2 + diagnosis.message.size();
  for (const auto& [key, value] : diagnosis.values) bytes += 16 + key.size() + value.size();
  return bytes;
}

}  // namespace

void write_pose(CdrWriter& writer, std::int64_t stamp_ns, const Place& place) {
  writer.start(kHeaderBytes + kPoseBytes);
  put_header(writer, stamp_ns);
  put_pose(writer, place);
}

void write_twist(CdrWriter& writer, std::int64_t stamp_ns, const Vec2& velocity_m_s) {
  writer.start(kHeaderBytes + kPoseBytes);
  put_header(writer, stamp_ns);
  put_vector(writer, velocity_m_s.x(), velocity_m_s.y(), 0.0);
  put_vector(writer, 0.0, 0.0, 0.0);
}

void write_path(CdrWriter& writer, std::int64_t stamp_ns, std::span<const Place> places) {
  writer.start(kHeaderBytes + places.size() * (kHeaderBytes + kPoseBytes));
  put_header(writer, stamp_ns);
  writer.count(places.size());
  for (const Place& place : places) {
    put_header(writer, stamp_ns);
    put_pose(writer, place);
  }
}

void write_number(CdrWriter& writer, double value) {
  writer.start(sizeof(double));
  writer.put(value);
}

void write_grid(CdrWriter& writer, std::int64_t stamp_ns, const field::DensityGrid& density,
                const field::WorldFrame& frame) {
  const auto cells = static_cast<std::size_t>(density.values.size());
  writer.start(2 * kHeaderBytes + kPoseBytes + cells);
  put_header(writer, stamp_ns);
  put_time(writer, stamp_ns);
  writer.put(static_cast<float>(density.field.length_x / static_cast<double>(density.values.rows())));
  writer.put(static_cast<std::uint32_t>(density.values.rows()));
  writer.put(static_cast<std::uint32_t>(density.values.cols()));
  put_pose(writer, {frame.origin_W, 0.0}, frame.yaw_rad);
  writer.count(cells);
  const double highest = density.values.maxCoeff();
  for (Eigen::Index iy = 0; iy < density.values.cols(); ++iy)
    for (Eigen::Index ix = 0; ix < density.values.rows(); ++ix)
      writer.put(static_cast<std::int8_t>(std::lround(100.0 * density.values(ix, iy) / highest)));
}

void write_diagnoses(CdrWriter& writer, std::int64_t stamp_ns, std::span<const DroneDiagnosis> diagnoses) {
  std::size_t bytes = kHeaderBytes;
  for (const DroneDiagnosis& diagnosis : diagnoses) bytes += bytes_of(diagnosis);
  writer.start(bytes);
  put_header(writer, stamp_ns);
  writer.count(diagnoses.size());
  for (const DroneDiagnosis& diagnosis : diagnoses) {
    writer.put(static_cast<std::uint8_t>(diagnosis.level));
    for (const std::string* text : {&diagnosis.drone, &diagnosis.message, &diagnosis.drone})
      writer.put(std::string_view(*text));
    writer.count(diagnosis.values.size());
    for (const auto& [key, value] : diagnosis.values) {
      writer.put(std::string_view(key));
      writer.put(std::string_view(value));
    }
  }
}

void write_drawings(CdrWriter& writer, std::int64_t stamp_ns, std::span<const Drawing> drawings) {
  std::size_t bytes = kHeaderBytes;
  for (const Drawing& drawing : drawings)
    bytes += kMarkerBytes + drawing.name.size() + drawing.places.size() * 3 * sizeof(double);
  writer.start(bytes);
  writer.count(drawings.size());
  for (const Drawing& drawing : drawings) put_drawing(writer, stamp_ns, drawing);
}

}  // namespace vigil::recording
