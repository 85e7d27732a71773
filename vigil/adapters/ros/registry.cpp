#include "vigil/adapters/ros/registry.hpp"

#include <mutex>
#include <set>

#include <ros/connection_manager.h>
#include <ros/master.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

namespace vigil::ros_bridge {
namespace {

using Value = XmlRpc::XmlRpcValue;

struct Services {
  std::mutex mutex;
  std::set<std::string> names;
};

Services& services() {
  static Services known;
  return known;
}

Value arguments() {
  Value list;
  list[0] = ros::this_node::getName();
  return list;
}

std::string own_uri() { return ros::XMLRPCManager::instance()->getServerURI(); }

/// A call of this node's own interface for others; empty where it fails.
Value ask_self(const char* method, const Value& request) {
  std::string host;
  std::uint32_t port = 0;
  Value response;
  if (!ros::network::splitURI(own_uri(), host, port)) return response;
  XmlRpc::XmlRpcClient* const client =
      ros::XMLRPCManager::instance()->getXMLRPCClient(host, static_cast<int>(port), "/");
  const bool is_done = client->execute(method, request, response);
  ros::XMLRPCManager::instance()->releaseXMLRPCClient(client);
  return is_done && response.getType() == Value::TypeArray && response.size() == 3 ? Value(response[2]) : Value();
}

bool tell_master(const char* method, const Value& request, Value& payload) {
  Value response;
  return ros::master::execute(method, request, response, payload, false);
}

bool register_topic(const char* method, const std::string& topic, const std::string& type, Value& payload) {
  Value request = arguments();
  request[1] = topic;
  request[2] = type;
  request[3] = own_uri();
  return tell_master(method, request, payload);
}

bool register_publishers() {
  Value topics = ask_self("getPublications", arguments());
  if (topics.getType() != Value::TypeArray) return false;
  bool is_whole = true;
  Value payload;
  for (int i = 0; i < topics.size(); ++i)
    is_whole = register_topic("registerPublisher", topics[i][0], topics[i][1], payload) && is_whole;
  return is_whole;
}

bool register_subscribers() {
  Value topics = ask_self("getSubscriptions", arguments());
  if (topics.getType() != Value::TypeArray) return false;
  bool is_whole = true;
  for (int i = 0; i < topics.size(); ++i) {
    Value publishers;
    if (!register_topic("registerSubscriber", topics[i][0], topics[i][1], publishers)) {
      is_whole = false;
      continue;
    }
    // A publisher that this master does not know yet will tell it, and then we are told: nobody is dropped for that.
    if (publishers.getType() != Value::TypeArray || publishers.size() == 0) continue;
    Value update = arguments();
    update[1] = topics[i][0];
    update[2] = publishers;
    ask_self("publisherUpdate", update);
  }
  return is_whole;
}

bool register_services() {
  const std::lock_guard<std::mutex> lock(services().mutex);
  bool is_whole = true;
  for (const std::string& name : services().names) {
    Value request = arguments();
    request[1] = name;
    request[2] =
        "rosrpc://" + ros::network::getHost() + ":" + std::to_string(ros::ConnectionManager::instance()->getTCPPort());
    request[3] = own_uri();
    Value payload;
    is_whole = tell_master("registerService", request, payload) && is_whole;
  }
  return is_whole;
}

}  // namespace

void note_service(const std::string& name) {
  const std::lock_guard<std::mutex> lock(services().mutex);
  services().names.insert(name);
}

bool register_everything() {
  const bool publishers = register_publishers();
  const bool subscribers = register_subscribers();
  return register_services() && publishers && subscribers;
}

}  // namespace vigil::ros_bridge
