#include "vigil/adapters/console/protocol_vectors.hpp"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace vigil::console {
namespace {

// The page's tests read the same files. Where this fails on purpose: build/dev/.../protocol_vectors protocol/vectors
TEST(ProtocolVectorsTest, What_the_program_says_is_what_the_files_hold) {
  const std::filesystem::path folder(VIGIL_PROTOCOL_DIR "/vectors");
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) files += entry.is_regular_file() ? 1U : 0U;
  EXPECT_EQ(files, protocol_vectors().size());
  for (const auto& [name, text] : protocol_vectors()) {
    std::ifstream file(folder / name, std::ios::binary);
    const std::string kept((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
    EXPECT_EQ(kept, text) << name;
  }
}

TEST(ProtocolVectorsTest, What_is_meant_to_be_refused_is_refused_and_the_rest_is_not) {
  const auto cases = nlohmann::json::parse(protocol_vectors().at("client_messages.json"));
  bool is_past_the_good_ones = false;
  for (const auto& one : cases) {
    if (one.at("name") == "not JSON") is_past_the_good_ones = true;
    EXPECT_EQ(one.at("is_accepted").get<bool>(), !is_past_the_good_ones) << one.at("name");
  }
  EXPECT_TRUE(is_past_the_good_ones);
}

}  // namespace
}  // namespace vigil::console
