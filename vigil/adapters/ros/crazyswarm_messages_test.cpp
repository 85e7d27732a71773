#include "vigil/adapters/ros/crazyswarm_messages.hpp"

#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <openssl/evp.h>

namespace vigil::ros_bridge::crazyswarm {
namespace {

std::string md5(const std::string& text) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
  unsigned int size = 0;
  EVP_Digest(text.data(), text.size(), digest.data(), &size, EVP_md5(), nullptr);
  std::string hex;
  for (unsigned int i = 0; i < size; ++i) {
    constexpr const char* kDigits = "0123456789abcdef";
    hex += kDigits[digest.at(i) / 16];
    hex += kDigits[digest.at(i) % 16];
  }
  return hex;
}

// A definition's sum by ROS' rule: its fields a line, types of other messages replaced by their sums.
TEST(CrazyswarmMessages, The_velocitys_sum_follows_from_its_fields) {
  const std::string header = ros::message_traits::md5sum<std_msgs::Header>();
  const std::string vector = ros::message_traits::md5sum<geometry_msgs::Vector3>();
  EXPECT_EQ(md5(header + " header\n" + vector + " vel\nfloat32 yawRate"), Wire<VelocityWorld>::kSum);
}

TEST(CrazyswarmMessages, The_services_sums_follow_from_their_fields) {
  EXPECT_EQ(md5("uint8 groupMask\nfloat32 height\nduration duration"), Wire<TakeoffRequest>::kSum);
  EXPECT_EQ(md5("uint8 groupMask\nfloat32 height\nduration duration"), Wire<LandRequest>::kSum);
  EXPECT_EQ(md5("uint8 groupMask\nuint32 remainValidMillisecs"), Wire<NotifySetpointsStopRequest>::kSum);
  EXPECT_EQ(md5(""), Wire<EmptyResponse<LandRequest>>::kSum);
}

// As Crazyswarm publishes them.
TEST(CrazyswarmMessages, The_sums_are_the_published_ones) {
  EXPECT_STREQ(ros::message_traits::md5sum<VelocityWorld>(), "5c7894b98f86c9f4dc7d7cb4971ec39d");
  EXPECT_STREQ(ros::service_traits::md5sum<TakeoffRequest>(), "b665b6c83a196e4774268cc26329b159");
  EXPECT_STREQ(ros::service_traits::md5sum<LandRequest>(), "b665b6c83a196e4774268cc26329b159");
  EXPECT_STREQ(ros::service_traits::datatype<TakeoffRequest>(), "crazyswarm/Takeoff");
  EXPECT_STREQ(ros::message_traits::datatype<VelocityWorld>(), "crazyswarm/VelocityWorld");
}

template <typename Message>
std::vector<std::uint8_t> bytes_of(const Message& message) {
  std::vector<std::uint8_t> bytes(ros::serialization::serializationLength(message));
  ros::serialization::OStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::serialize(stream, message);
  return bytes;
}

TEST(CrazyswarmMessages, A_request_is_packed_field_behind_field) {
  TakeoffRequest request;
  request.groupMask = 7;
  request.height = 1.0F;
  request.duration = ros::Duration(2, 3);
  EXPECT_EQ(bytes_of(request), (std::vector<std::uint8_t>{7, 0, 0, 0x80, 0x3F, 2, 0, 0, 0, 3, 0, 0, 0}));
}

TEST(CrazyswarmMessages, A_velocity_comes_back_as_it_went) {
  VelocityWorld sent;
  sent.header.frame_id = "world";
  sent.vel.x = 0.25;
  sent.yawRate = 1.5F;
  std::vector<std::uint8_t> bytes = bytes_of(sent);
  EXPECT_EQ(bytes.size(), 4U + 8U + 4U + 5U + 24U + 4U);
  VelocityWorld got;
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, got);
  EXPECT_EQ(got.header.frame_id, "world");
  EXPECT_EQ(got.vel.x, 0.25);
  EXPECT_EQ(got.yawRate, 1.5F);
}

}  // namespace
}  // namespace vigil::ros_bridge::crazyswarm
