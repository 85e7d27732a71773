#pragma once

#include <cstdint>

#include <geometry_msgs/Vector3.h>
#include <ros/duration.h>
#include <ros/message_traits.h>
#include <ros/serialization.h>
#include <ros/service_traits.h>
#include <std_msgs/Header.h>

/// The messages and services of ROS package `crazyswarm` that a fleet speaks, as the wire has them: field names and
/// order are Crazyswarm's. Of the files that speak to roscpp only.
namespace vigil::ros_bridge::crazyswarm {

struct VelocityWorld {
  std_msgs::Header header;
  geometry_msgs::Vector3 vel;  ///< m/s
  float yawRate = 0.0F;
};

/// Of services Takeoff and Land, whose requests are alike but for their names.
struct HeightRequest {
  std::uint8_t groupMask = 0;  ///< 0: this drone, whatever its groups
  float height = 0.0F;         ///< metres
  ros::Duration duration;
};
struct TakeoffRequest : HeightRequest {};
struct LandRequest : HeightRequest {};

/// Lets go of streamed setpoints, so that what follows is obeyed.
struct NotifySetpointsStopRequest {
  std::uint8_t groupMask = 0;
  std::uint32_t remainValidMillisecs = 0;
};

/// Of the service with this request.
template <typename Request>
struct EmptyResponse {};

/// What a type is called, and the sum by which two nodes know that they mean the same.
template <typename Message>
struct Wire;
template <>
struct Wire<VelocityWorld> {
  static constexpr const char* kName = "crazyswarm/VelocityWorld";
  static constexpr const char* kSum = "5c7894b98f86c9f4dc7d7cb4971ec39d";
  static constexpr const char* kDefinition =
      "std_msgs/Header header\n"
      "geometry_msgs/Vector3 vel\n"
      "float32 yawRate\n"
      "================================================================================\n"
      "MSG: std_msgs/Header\n"
      "uint32 seq\n"
      "time stamp\n"
      "string frame_id\n"
      "================================================================================\n"
      "MSG: geometry_msgs/Vector3\n"
      "float64 x\n"
      "float64 y\n"
      "float64 z\n";
};
template <>
struct Wire<TakeoffRequest> {
  static constexpr const char* kService = "crazyswarm/Takeoff";
  static constexpr const char* kName = "crazyswarm/TakeoffRequest";
  static constexpr const char* kSum = "b665b6c83a196e4774268cc26329b159";
  static constexpr const char* kDefinition = "uint8 groupMask\nfloat32 height\nduration duration\n";
};
template <>
struct Wire<LandRequest> {
  static constexpr const char* kService = "crazyswarm/Land";
  static constexpr const char* kName = "crazyswarm/LandRequest";
  static constexpr const char* kSum = "b665b6c83a196e4774268cc26329b159";
  static constexpr const char* kDefinition = "uint8 groupMask\nfloat32 height\nduration duration\n";
};
template <>
struct Wire<NotifySetpointsStopRequest> {
  static constexpr const char* kService = "crazyswarm/NotifySetpointsStop";
  static constexpr const char* kName = "crazyswarm/NotifySetpointsStopRequest";
  static constexpr const char* kSum = "5e1e40fcf516d3883bc228627d3e1e43";
  static constexpr const char* kDefinition = "uint8 groupMask\nuint32 remainValidMillisecs\n";
};
template <typename Request>
struct Wire<EmptyResponse<Request>> {
  static constexpr const char* kName = "crazyswarm/EmptyResponse";
  static constexpr const char* kSum = "d41d8cd98f00b204e9800998ecf8427e";  // of no bytes
  static constexpr const char* kDefinition = "";
};

// What roscpp asks of a type.
template <typename Type>
struct SumOf {
  static const char* value() { return Wire<Type>::kSum; }
  static const char* value(const Type& /*message*/) { return value(); }
};
template <typename Type>
struct NameOf {
  static const char* value() { return Wire<Type>::kName; }
  static const char* value(const Type& /*message*/) { return value(); }
};
template <typename Type>
struct DefinitionOf {
  static const char* value() { return Wire<Type>::kDefinition; }
  static const char* value(const Type& /*message*/) { return value(); }
};
template <typename Request>
struct ServiceNameOf {
  static const char* value() { return Wire<Request>::kService; }
  template <typename Message>
  static const char* value(const Message& /*message*/) {
    return value();
  }
};
/// Both halves of a service are known by the sum of the whole; its response is empty, so that it is the request's.
template <typename Request>
struct ServiceSumOf {
  static const char* value() { return Wire<Request>::kSum; }
  template <typename Message>
  static const char* value(const Message& /*message*/) {
    return value();
  }
};

}  // namespace vigil::ros_bridge::crazyswarm

namespace ros {
namespace message_traits {

namespace ours = vigil::ros_bridge::crazyswarm;

template <>
struct MD5Sum<ours::VelocityWorld> : ours::SumOf<ours::VelocityWorld> {};
template <>
struct DataType<ours::VelocityWorld> : ours::NameOf<ours::VelocityWorld> {};
template <>
struct Definition<ours::VelocityWorld> : ours::DefinitionOf<ours::VelocityWorld> {};
template <>
struct MD5Sum<ours::TakeoffRequest> : ours::SumOf<ours::TakeoffRequest> {};
template <>
struct DataType<ours::TakeoffRequest> : ours::NameOf<ours::TakeoffRequest> {};
template <>
struct Definition<ours::TakeoffRequest> : ours::DefinitionOf<ours::TakeoffRequest> {};
template <>
struct MD5Sum<ours::LandRequest> : ours::SumOf<ours::LandRequest> {};
template <>
struct DataType<ours::LandRequest> : ours::NameOf<ours::LandRequest> {};
template <>
struct Definition<ours::LandRequest> : ours::DefinitionOf<ours::LandRequest> {};
template <>
struct MD5Sum<ours::NotifySetpointsStopRequest> : ours::SumOf<ours::NotifySetpointsStopRequest> {};
template <>
struct DataType<ours::NotifySetpointsStopRequest> : ours::NameOf<ours::NotifySetpointsStopRequest> {};
template <>
struct Definition<ours::NotifySetpointsStopRequest> : ours::DefinitionOf<ours::NotifySetpointsStopRequest> {};
template <typename Request>
struct MD5Sum<ours::EmptyResponse<Request>> : ours::SumOf<ours::EmptyResponse<Request>> {};
template <typename Request>
struct DataType<ours::EmptyResponse<Request>> : ours::NameOf<ours::EmptyResponse<Request>> {};
template <typename Request>
struct Definition<ours::EmptyResponse<Request>> : ours::DefinitionOf<ours::EmptyResponse<Request>> {};

}  // namespace message_traits

namespace service_traits {

namespace ours = vigil::ros_bridge::crazyswarm;

template <>
struct MD5Sum<ours::TakeoffRequest> : ours::ServiceSumOf<ours::TakeoffRequest> {};
template <>
struct DataType<ours::TakeoffRequest> : ours::ServiceNameOf<ours::TakeoffRequest> {};
template <>
struct MD5Sum<ours::LandRequest> : ours::ServiceSumOf<ours::LandRequest> {};
template <>
struct DataType<ours::LandRequest> : ours::ServiceNameOf<ours::LandRequest> {};
template <>
struct MD5Sum<ours::NotifySetpointsStopRequest> : ours::ServiceSumOf<ours::NotifySetpointsStopRequest> {};
template <>
struct DataType<ours::NotifySetpointsStopRequest> : ours::ServiceNameOf<ours::NotifySetpointsStopRequest> {};
template <typename Request>
struct MD5Sum<ours::EmptyResponse<Request>> : ours::ServiceSumOf<Request> {};
template <typename Request>
struct DataType<ours::EmptyResponse<Request>> : ours::ServiceNameOf<Request> {};

}  // namespace service_traits

namespace serialization {

namespace ours = vigil::ros_bridge::crazyswarm;

template <>
struct Serializer<ours::VelocityWorld> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.header);
    stream.next(message.vel);
    stream.next(message.yawRate);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

/// Of both requests with a height.
struct HeightSerializer {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.groupMask);
    stream.next(message.height);
    stream.next(message.duration);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};
template <>
struct Serializer<ours::TakeoffRequest> : HeightSerializer {};
template <>
struct Serializer<ours::LandRequest> : HeightSerializer {};

template <>
struct Serializer<ours::NotifySetpointsStopRequest> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& stream, Message message) {
    stream.next(message.groupMask);
    stream.next(message.remainValidMillisecs);
  }
  ROS_DECLARE_ALLINONE_SERIALIZER
};

template <typename Request>
struct Serializer<ours::EmptyResponse<Request>> {
  template <typename Stream, typename Message>
  static void allInOne(Stream& /*stream*/, Message /*message*/) {}
  ROS_DECLARE_ALLINONE_SERIALIZER
};

}  // namespace serialization
}  // namespace ros
