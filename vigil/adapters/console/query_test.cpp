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

TEST(Query, Tells_a_name_that_is_there_twice) {
  EXPECT_TRUE(names_twice("drone=a&x=1&drone=b", "drone"));
  EXPECT_TRUE(names_twice("drone=a&drone=a", "drone"));
  EXPECT_FALSE(names_twice("drone=a&my_drone=b&drone", "drone"));
  EXPECT_FALSE(names_twice("", "drone"));
}

TEST(Query, Percent_signs_are_decoded) {
  EXPECT_EQ(query_value("drone=two%20words%26%c3%a9", "drone"), "two words&\xc3\xa9");
  for (const char* query : {"drone=%", "drone=a%2", "drone=%zz", "drone=%-1"})
    EXPECT_EQ(query_value(query, "drone"), std::nullopt) << query;
}

}  // namespace
}  // namespace vigil::console
