#include "vigil/runtime/mission_writer.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_file.hpp"
#include "vigil/runtime/random_mission.hpp"

namespace vigil::runtime {
namespace {

RC_GTEST_PROP(MissionWriter, A_written_mission_reads_back_bit_for_bit, ()) {
  const Mission mission = random_mission(*rc::gen::arbitrary<std::uint64_t>());
  const std::string yaml = mission_yaml(mission);
  const Mission again = parse_mission(yaml, "written");
  RC_ASSERT(again == mission);
  RC_ASSERT(mission_yaml(again) == yaml);
}

TEST(MissionWriter, A_right_mission_survives_writing) {
  const Mission mission = parse_mission(right_mission(), "right");
  EXPECT_EQ(parse_mission(mission_yaml(mission), "written"), mission);
}

TEST(MissionWriter, It_writes_defaults_but_not_what_is_derived) {
  const std::string yaml = mission_yaml(parse_mission(right_mission(), "right"));
  EXPECT_NE(yaml.find("  fade: 0.1\n"), std::string::npos);
  EXPECT_NE(yaml.find("  tracker:\n    noise_m: 0\n"), std::string::npos);
  EXPECT_EQ(yaml.find("sensing_range_m"), std::string::npos);
}

TEST(MissionWriter, A_section_without_a_value_is_written_as_empty) {
  const std::string yaml =
      mission_yaml(parse_mission(right_mission_but("sensor: {footprint_radius_m: 0.3}\n", ""), "right"));
  EXPECT_NE(yaml.find("\nsensor: {}\n"), std::string::npos);
}

}  // namespace
}  // namespace vigil::runtime
