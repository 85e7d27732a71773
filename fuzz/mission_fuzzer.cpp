#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "vigil/runtime/mission_explanation.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/mission_text.hpp"
#include "vigil/runtime/mission_writer.hpp"

/// Any bytes for a mission file. They are refused by a MissionError of one line, or make a mission that can be
/// explained and that survives being written and read. Whatever follows a NUL byte is an override, as after --set.
namespace {

using vigil::runtime::Mission;
using vigil::runtime::MissionError;
using vigil::runtime::Override;

/// Writing, reading and comparing more drones than that takes longer than it is worth.
constexpr std::size_t kMostDrones = 1000;

[[noreturn]] void fail(const char* what, std::string_view detail) {
  std::fprintf(stderr, "%s: %.*s\n", what, static_cast<int>(detail.size()), detail.data());
  std::abort();
}

std::vector<std::string_view> split_at_nul(std::string_view bytes) {
  std::vector<std::string_view> parts;
  for (std::size_t begin = 0; begin <= bytes.size();) {
    const std::size_t end = std::min(bytes.find('\0', begin), bytes.size());
    parts.push_back(bytes.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

Mission parse(std::string_view bytes) {
  const std::vector<std::string_view> parts = split_at_nul(bytes);
  std::vector<Override> overrides;
  for (std::size_t i = 1; i < parts.size(); ++i) overrides.push_back(vigil::runtime::parse_override(parts[i]));
  return vigil::runtime::parse_mission(parts[0], "fuzz", overrides);
}

void require_one_line(std::string_view message) {
  for (const char c : message) {
    if (static_cast<unsigned char>(c) < 0x20U) fail("a refusal of several lines", message);
  }
}

void require_same_after_writing(const Mission& mission) {
  const std::string yaml = vigil::runtime::mission_yaml(mission);
  if (yaml.size() > vigil::runtime::kMostMissionBytes) return;
  try {
    if (vigil::runtime::parse_mission(yaml, "written") != mission) fail("not the same after writing", yaml);
  } catch (const MissionError& error) {
    fail(error.what(), yaml);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Mission mission;
  try {
    mission = parse({reinterpret_cast<const char*>(data), size});  // NOLINT: bytes are bytes
  } catch (const MissionError& error) {
    require_one_line(error.what());
    return 0;
  }
  if (mission.drones.size() > kMostDrones) return 0;
  require_same_after_writing(mission);
  if (vigil::runtime::explain(mission).empty()) fail("not explained", mission.name);
  return 0;
}
