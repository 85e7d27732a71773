#include "vigil/adapters/console/query.hpp"

#include <gtest/gtest.h>

namespace vigil::console {
namespace {

TEST(Query, Gives_the_value_of_a_name_and_nothing_of_the_others) {
  EXPECT_EQ(query_value("drone=cf1", "drone"), "cf1");
  EXPECT_EQ(query_value("x=1&drone=cf1&drone=cf2&y=", "drone"), "cf1");
  EXPECT_EQ(query_value("drone=", "drone"), "");
  EXPECT_EQ(query_value("my_drone=a&drone", "drone"), std::nullopt);
  EXPECT_EQ(query_value("", "drone"), std::nullopt);
}

TEST(Query, A_name_that_is_unknown_or_there_twice_is_a_problem) {
  for (const char* query : {"", "&", "drone=a", "drone=a&", "drone", "drone=my=drone"})
    EXPECT_EQ(query_problem(query, "drone"), "") << query;
  EXPECT_EQ(query_problem("drone=a&drone=b", "drone"), "drone: is there twice; give it once");
  EXPECT_EQ(query_problem("drone=a&drone", "drone"), "drone: is there twice; give it once");
  EXPECT_EQ(query_problem("drone=a&my_drone=b", "drone"), "my_drone: is not known here; known is drone");
  EXPECT_EQ(query_problem("drone=a", ""), "drone: is not known here; this path takes no query");
  EXPECT_LT(query_problem(std::string(100'000, 'x'), "").size(), 100U);
}

TEST(Query, Percent_signs_are_decoded) {
  EXPECT_EQ(query_value("drone=two%20words%26%c3%a9", "drone"), "two words&\xc3\xa9");
  for (const char* query : {"drone=%", "drone=a%2", "drone=%zz", "drone=%-1"})
    EXPECT_EQ(query_value(query, "drone"), std::nullopt) << query;
}

}  // namespace
}  // namespace vigil::console
