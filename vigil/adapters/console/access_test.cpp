#include "vigil/adapters/console/access.hpp"

#include <gtest/gtest.h>

#include "vigil/adapters/console/rate_limit.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;

TEST(AccessTest, Texts_are_equal_only_where_every_byte_is) {
  EXPECT_TRUE(equal_in_constant_time("abc", "abc"));
  EXPECT_TRUE(equal_in_constant_time("", ""));
  EXPECT_FALSE(equal_in_constant_time("abc", "abd"));
  EXPECT_FALSE(equal_in_constant_time("abc", "abcabc"));
  EXPECT_FALSE(equal_in_constant_time("abcabc", "abc"));
  EXPECT_FALSE(equal_in_constant_time("abc", ""));
  EXPECT_FALSE(equal_in_constant_time("", "abc"));
}

TEST(AccessTest, A_token_opens_its_role_and_nothing_else_does) {
  const Tokens tokens = Tokens::parse("# doors\n\nviewer aaaaaaaaaaaaaaaa\noperator\tbbbbbbbbbbbbbbbb\r\n", "tokens");
  EXPECT_EQ(tokens.role_for("aaaaaaaaaaaaaaaa"), Role::kViewer);
  EXPECT_EQ(tokens.role_for("bbbbbbbbbbbbbbbb"), Role::kOperator);
  EXPECT_EQ(tokens.role_for(""), std::nullopt);
  EXPECT_EQ(tokens.role_for("aaaaaaaaaaaaaaa"), std::nullopt);
  EXPECT_EQ(tokens.role_for("aaaaaaaaaaaaaaaab"), std::nullopt);
}

TEST(AccessTest, A_file_of_tokens_that_opens_too_much_or_nothing_is_refused_with_its_line) {
  for (const char* text :
       {"", "# nothing\n", "admiral aaaaaaaaaaaaaaaa\n", "viewer short\n", "viewer\n",
        "viewer aaaaaaaaaaaaaaaa and more\n", "viewer aaaaaaaaaaaaaaaa\noperator aaaaaaaaaaaaaaaa\n"}) {
    EXPECT_THROW((void)Tokens::parse(text, "tokens"), SetupError) << text;
  }
  try {
    (void)Tokens::parse("viewer aaaaaaaaaaaaaaaa\nviewer short\n", "tokens");
    FAIL();
  } catch (const SetupError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 9), "tokens:2:");
  }
}

TEST(AccessTest, On_loopback_every_name_of_loopback_and_no_other_comes_in) {
  const Gate gate("127.0.0.1", {"Base.example.org"});
  for (const char* host :
       {"127.0.0.1", "127.0.0.1:8080", "localhost:9000", "[::1]:8080", "LOCALHOST", "base.example.org"})
    EXPECT_TRUE(gate.admits_host(host)) << host;
  for (const char* host :
       {"", "evil.example", "127.0.0.1.evil.example", "localhost.evil.example:8080", "::1", "0.0.0.0"})
    EXPECT_FALSE(gate.admits_host(host)) << host;
}

TEST(AccessTest, A_page_comes_in_only_where_it_was_served) {
  const Gate gate("127.0.0.1", {});
  EXPECT_TRUE(gate.admits_origin("", "localhost:8080"));  // no browser
  EXPECT_TRUE(gate.admits_origin("http://localhost:8080", "localhost:8080"));
  EXPECT_TRUE(gate.admits_origin("https://LOCALHOST:8080", "localhost:8080"));
  for (const char* origin : {"null", "http://evil.example", "http://localhost:9999", "http://localhost", "file://",
                             "http://localhost:8080.evil.example", "localhost:8080"})
    EXPECT_FALSE(gate.admits_origin(origin, "localhost:8080")) << origin;
  EXPECT_FALSE(gate.admits_origin("http://evil.example", "evil.example"));
}

TEST(RateLimitTest, A_burst_is_allowed_then_so_many_a_second) {
  RateLimit limit(50.0, 3.0);
  EXPECT_TRUE(limit.admit(1s) && limit.admit(1s) && limit.admit(1s));
  EXPECT_FALSE(limit.admit(1s));
  EXPECT_FALSE(limit.admit(1s + 19ms));
  EXPECT_TRUE(limit.admit(1s + 21ms));
  EXPECT_FALSE(limit.admit(1s + 21ms));
}

}  // namespace
}  // namespace vigil::console
