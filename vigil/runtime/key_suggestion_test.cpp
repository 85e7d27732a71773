#include "vigil/runtime/key_suggestion.hpp"

#include <array>

#include <gtest/gtest.h>

namespace vigil::runtime {
namespace {

constexpr std::array<std::string_view, 4> kKnown{"rate_hz", "speed_limit_m_s", "separation_m", "fade"};

TEST(KeySuggestion, A_slip_of_the_finger_finds_its_key) {
  EXPECT_EQ(suggestion_for("seperation_m", kKnown), "did you mean separation_m?");
  EXPECT_EQ(suggestion_for("fad", kKnown), "did you mean fade?");
}

TEST(KeySuggestion, A_missing_or_wrong_unit_is_said_to_be_part_of_the_key) {
  EXPECT_EQ(suggestion_for("rate", kKnown), "did you mean rate_hz? units are part of the key");
  EXPECT_EQ(suggestion_for("speed_limit", kKnown), "did you mean speed_limit_m_s? units are part of the key");
  EXPECT_EQ(suggestion_for("separation_cm", kKnown), "did you mean separation_m? units are SI and part of the key");
}

TEST(KeySuggestion, A_word_like_no_key_suggests_none) {
  EXPECT_EQ(suggestion_for("temperature", kKnown), "remove it");
  EXPECT_EQ(suggestion_for(std::string(10'000, 'x'), kKnown), "remove it");
  EXPECT_EQ(suggestion_for("x", {}), "remove it");
}

}  // namespace
}  // namespace vigil::runtime
