#include <algorithm>
#include <cctype>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <sys/stat.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "vigil/runtime/malformed_missions.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::runtime {
namespace {

/// A folder of its own that goes with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "vigil-mission-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data());
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  [[nodiscard]] std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

MissionFault fault_of(const std::function<void()>& load) {
  try {
    load();
  } catch (const MissionError& error) {
    return error.fault();
  }
  ADD_FAILURE() << "nothing was refused";
  return {};
}

bool is_one_line(std::string_view text) {
  return !text.empty() && std::ranges::none_of(text, [](char c) { return static_cast<unsigned char>(c) < 0x20U; });
}

class MalformedMissions : public testing::TestWithParam<MalformedMission> {};

TEST_P(MalformedMissions, Are_refused_with_place_value_range_and_advice_on_one_line) {
  const MalformedMission& malformed = GetParam();
  try {
    static_cast<void>(parse_mission(malformed.text, "bad.yaml"));
    FAIL() << malformed.name << " is accepted";
  } catch (const MissionError& error) {
    const MissionFault& fault = error.fault();
    EXPECT_EQ(fault.key, malformed.key);
    EXPECT_NE(std::string_view(error.what()).find(malformed.message), std::string_view::npos) << error.what();
    EXPECT_TRUE(is_one_line(error.what())) << error.what();
    EXPECT_TRUE(fault.place.starts_with("bad.yaml")) << error.what();
    EXPECT_FALSE(fault.valid.empty()) << error.what();
    EXPECT_FALSE(fault.advice.empty()) << error.what();
    const bool has_a_value = malformed.fault != Fault::kText && fault.problem != "is missing";
    EXPECT_TRUE(!fault.value.empty() || !has_a_value) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(Table, MalformedMissions, testing::ValuesIn(malformed_missions()), [](const auto& row) {
  std::string name = row.param.name;
  std::ranges::replace_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

TEST(MissionRefusal, The_line_and_column_are_those_of_the_value) {
  const MissionFault fault = fault_of(
      [] { static_cast<void>(parse_mission(right_mission_but("separation_m: 0.2", "separation_m: -0.2"), "x.yaml")); });
  EXPECT_EQ(fault.place, "x.yaml:21:17");
  EXPECT_EQ(fault.key, "safety.separation_m");
  EXPECT_EQ(fault.value, "-0.2");
  EXPECT_EQ(fault.valid, "must be in (0, 100000] m");
  EXPECT_EQ(fault.advice, "give the least allowed distance R_s between two drones' centres");
}

TEST(MissionRefusal, Long_values_are_cut_and_their_control_characters_escaped) {
  const MissionError error({.place = "x.yaml:1:1",
                            .key = "name",
                            .value = "a\nb\x1B[2J" + std::string(500, 'x'),
                            .problem = "",
                            .valid = "must be short",
                            .advice = ""});
  EXPECT_TRUE(is_one_line(error.what()));
  EXPECT_TRUE(std::string_view(error.what()).starts_with("x.yaml:1:1: name = a\\nb\\x1b[2Jxxx"));
  EXPECT_TRUE(std::string_view(error.what()).ends_with("x...: must be short"));
  EXPECT_LT(std::string_view(error.what()).size(), 150U);
}

TEST(MissionRefusal, A_file_of_100_MB_is_refused_before_it_is_read) {
  const TemporaryFolder folder;
  const std::filesystem::path path = folder / "large.yaml";
  std::ofstream(path).close();
  std::filesystem::resize_file(path, 100'000'000);
  const auto begin = std::chrono::steady_clock::now();
  const MissionFault fault = fault_of([&] { static_cast<void>(load_mission(path)); });
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::milliseconds(100));
  EXPECT_EQ(fault.problem, "has 100000000 bytes");
  EXPECT_EQ(fault.place, path.string());
}

TEST(MissionRefusal, What_is_no_regular_file_is_refused_and_never_waited_for) {
  const TemporaryFolder folder;
  const std::filesystem::path pipe = folder / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_EQ(fault_of([&] { static_cast<void>(load_mission(pipe)); }).problem, "is not a regular file");
  EXPECT_EQ(fault_of([] { static_cast<void>(load_mission("/dev/zero")); }).problem, "is not a regular file");
  EXPECT_EQ(fault_of([&] { static_cast<void>(load_mission(folder.path())); }).problem, "is a directory");
  EXPECT_EQ(fault_of([&] { static_cast<void>(load_mission(folder / "none.yaml")); }).problem,
            "cannot be opened: No such file or directory");
}

TEST(MissionRefusal, A_file_says_the_same_as_its_text) {
  const TemporaryFolder folder;
  std::ofstream(folder / "right.yaml") << right_mission();
  EXPECT_EQ(load_mission(folder / "right.yaml"), parse_mission(right_mission(), "right"));
}

}  // namespace
}  // namespace vigil::runtime
