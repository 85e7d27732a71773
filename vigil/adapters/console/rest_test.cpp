#include "vigil/adapters/console/rest.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "vigil/adapters/console/areas_geojson.hpp"
#include "vigil/adapters/console/client_message.hpp"
#include "vigil/adapters/console/console_for_tests.hpp"
#include "vigil/runtime/mission_file.hpp"

namespace vigil::console {
namespace {

using namespace std::chrono_literals;

constexpr const char* kArea =
    R"({"type":"FeatureCollection","vigil":{"frame":"world","unit":"m"},"features":[{"type":"Feature","properties":{"name":"hall"},
  "geometry":{"type":"Polygon","coordinates":[[[-0.5,10.5],[0,10.5],[0,11],[-0.5,10.5]]]}}]})";

/// A small triangle from `x` on to the right, as a polygon's list of rings.
std::string ring_at(double x) {
  return fmt::format("[[[{0:.1f},10.5],[{1:.1f},10.5],[{0:.1f},10.6],[{0:.1f},10.5]]]", x, x + 0.1);
}
std::string polygon_at(double x) { return fmt::format(R"({{"type":"Polygon","coordinates":{}}})", ring_at(x)); }

/// A file of one feature.
std::string collection(const std::string& properties, const std::string& geometry) {
  return fmt::format(
      R"({{"type":"FeatureCollection","vigil":{{"frame":"world","unit":"m"}},"features":[{{"type":"Feature","properties":{},"geometry":{}}}]}})",
      properties, geometry);
}

/// The console's REST interface on a flying swarm; `console.fly()` is the test's.
class RestTest : public ::testing::Test {
 protected:
  explicit RestTest(std::optional<Tokens> tokens = {}) : console(std::move(tokens)) {}

  static HttpRequest get(const std::string& target) {
    HttpRequest request;
    request.method = "GET";
    request.target = target;
    request.host = "127.0.0.1:8080";
    return request;
  }
  static HttpRequest post(const std::string& target, std::string body) {
    HttpRequest request = get(target);
    request.method = "POST";
    request.content_type = "application/json";
    request.body = std::move(body);
    return request;
  }
  static HttpRequest command(const Json& body) { return post("/api/commands", body.dump()); }
  static HttpRequest preview(const Json& body) { return post("/api/preview", body.dump()); }

  /// The one answer, once there is one.
  HttpAnswer ask(const HttpRequest& request) {
    std::vector<HttpAnswer> answers;
    rest.answer(request, [&answers](HttpAnswer answer) { answers.push_back(std::move(answer)); });
    console.pass_until([&] { return !answers.empty(); });
    console.pass(200ms);
    EXPECT_EQ(answers.size(), 1U) << request.method << request.target;
    const std::string path = request.target.substr(0, request.target.find('?'));
    given.insert(request.method + " " + path + " " + std::to_string(answers.at(0).status));
    return answers.at(0);
  }
  int status(const HttpRequest& request) { return ask(request).status; }
  Json json(const HttpRequest& request) { return Json::parse(*ask(request).body); }

  ConsoleForTests console;
  Gate gate{"127.0.0.1", {}};
  Page page{"no such folder"};
  Rest rest{console.hub, gate, page};
  std::set<std::string> given;  ///< "GET /api/state 200", for all that was asked
};

class LockedRestTest : public RestTest {
 protected:
  LockedRestTest()
      : RestTest(Tokens::parse("viewer viewer-0123456789\noperator operator-0123456789\n", "the test's tokens")) {}
};

TEST_F(RestTest, Before_anything_is_flown_it_says_so) {
  for (const char* target : {"/api/state", "/api/mission", "/api/areas", "/api/why?drone=a"})
    EXPECT_EQ(status(get(target)), 503) << target;
  EXPECT_EQ(status(post("/api/areas", kArea)), 503);
  EXPECT_EQ(json(command({{"type", "land_all"}, {"id", 1}})).at("code"), "not_now");
  EXPECT_EQ(json(get("/api/version")).at("login"), false);
}

TEST_F(RestTest, Why_is_answered_for_one_drone_at_a_time) {
  console.fly();
  console.pass(100ms);
  const HttpAnswer answer = ask(get("/api/why?drone=a&drone=b"));
  EXPECT_EQ(answer.status, 400);
  EXPECT_NE(answer.body->find("drone: is there twice"), std::string::npos);
  EXPECT_EQ(status(get("/api/why?drone=a")), 200);
}

TEST_F(RestTest, A_query_that_is_not_known_is_refused_and_nothing_is_done) {
  console.fly();
  console.pass(100ms);
  for (const char* target : {"/api/state?drone=a", "/api/areas?format=yaml", "/api/mission?format=json",
                             "/api/mission?form=yaml", "/api/mission?format=yaml&format=yaml", "/api/why?drones=a"})
    EXPECT_EQ(json(get(target)).at("code"), "malformed") << target;
  HttpRequest request = command({{"type", "land_all"}, {"id", 1}});
  request.target += "?really=no";
  EXPECT_EQ(status(request), 400);
  console.pass(100ms);
  EXPECT_EQ(json(get("/api/state")).at("active"), 3);
  EXPECT_EQ(status(get("/api/mission?format=yaml")), 200);
}

TEST_F(RestTest, The_state_is_the_swarms_in_the_world_frame) {
  console.fly();
  console.pass(100ms);
  const Json state = json(get("/api/state"));
  EXPECT_EQ(state.at("active"), 3);
  const Json& drone = state.at("drones").at(0);
  EXPECT_EQ(drone.at("id"), "a");
  EXPECT_NEAR(drone.at("position_m").at(0), -0.5, 0.1);  // where it started, but for 0.1 s of flight
  EXPECT_NEAR(drone.at("position_m").at(1), 10.5, 0.1);
  EXPECT_TRUE(drone.at("battery_time_left_s").is_null());  // without a battery that is reported
  EXPECT_TRUE(drone.at("pad").is_null());                  // nor stations
  EXPECT_TRUE(drone.at("leaves_in_s").is_null());
}

TEST_F(RestTest, The_mission_is_given_as_json_or_as_a_file_that_can_be_flown) {
  console.fly();
  EXPECT_EQ(json(get("/api/mission")).at("name"), "small");
  HttpRequest by_header = get("/api/mission");
  by_header.accept = "application/yaml";
  for (const HttpRequest& request : {get("/api/mission?format=yaml"), by_header}) {
    const HttpAnswer answer = ask(request);
    EXPECT_EQ(answer.content_type, "application/yaml");
    EXPECT_EQ(runtime::parse_mission(*answer.body, "the answer").targets, runtime::small_mission().targets);
  }
}

TEST_F(RestTest, Areas_go_out_and_come_in_again) {
  console.fly();
  EXPECT_EQ(ask(get("/api/areas")).content_type, "application/geo+json");
  EXPECT_EQ(status(post("/api/areas", kArea)), 200);
  EXPECT_EQ(console.hub.mission()->targets.areas.back().name, "hall");
  EXPECT_EQ(status(post("/api/areas", *ask(get("/api/areas")).body)), 200);
  EXPECT_EQ(console.hub.mission()->targets.areas.size(), 2U);
  EXPECT_EQ(json(post("/api/areas", R"({"type":"FeatureCollection","features":[]})")).at("code"), "invalid");
}

TEST_F(RestTest, Areas_in_degrees_are_never_taken_for_metres) {
  console.fly();
  const std::string features = R"("features":[{"type":"Feature","properties":{"kind":"no_fly","name":"line"},
    "geometry":{"type":"Polygon","coordinates":[[[0.1,10.1],[0.2,10.1],[0.2,10.2],[0.1,10.1]]]}}]})";
  const auto answer = [&](const std::string& says) {
    return json(post("/api/areas", R"({"type":"FeatureCollection",)" + says + features));
  };
  const std::size_t before = console.hub.mission()->no_fly.size();
  const std::string metres = R"("vigil":{"frame":"world","unit":"m"},)";
  const std::string crs = R"("crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)";
  for (const std::string& says : {std::string(), crs, metres + crs, std::string(R"("frame":"world",)"),
                                  std::string(R"("vigil":{"frame":"world","unit":"ft"},)")}) {
    const Json refused = answer(says);
    EXPECT_EQ(refused.at("code"), "invalid") << says;
    EXPECT_NE(std::string(refused.at("reason")).find("longitude and latitude"), std::string::npos) << says;
  }
  EXPECT_EQ(console.hub.mission()->no_fly.size(), before);
  EXPECT_EQ(answer(metres).at("type"), "ack");
}

TEST_F(RestTest, Areas_that_come_in_replace_those_of_their_name_and_get_free_names_where_they_have_none) {
  console.fly();
  const auto names = [this] {
    std::vector<std::string> all;
    for (const auto& area : console.hub.mission()->targets.areas) all.push_back(area.name);
    return all;
  };
  const std::size_t before = names().size();
  const std::string heavy = std::regex_replace(std::string(kArea), std::regex("\"name\":"), R"("weight":9,"name":)");
  EXPECT_EQ(status(post("/api/areas", kArea)), 200);
  EXPECT_EQ(status(post("/api/areas", heavy)), 200);
  EXPECT_EQ(names().size(), before + 1);
  EXPECT_EQ(console.hub.mission()->targets.areas.back().weight, 9.0);
  const std::string nameless = collection("{}", polygon_at(0.2));
  for (int times = 0; times < 2; ++times) EXPECT_EQ(status(post("/api/areas", nameless)), 200);
  EXPECT_EQ(names().size(), before + 3);
  EXPECT_EQ(names().at(before + 1), "imported");
  EXPECT_EQ(names().back(), "imported-2");
}

TEST_F(RestTest, Every_polygon_of_a_multi_polygon_is_an_area_with_a_number) {
  console.fly();
  const std::string both =
      fmt::format(R"({{"type":"MultiPolygon","coordinates":[{},{}]}})", ring_at(0.2), ring_at(0.6));
  EXPECT_EQ(status(post("/api/areas", collection(R"({"name":"wood"})", both))), 200);
  const auto& areas = console.hub.mission()->targets.areas;
  ASSERT_GE(areas.size(), 2U);
  EXPECT_EQ(areas[areas.size() - 2].name, "wood-1");
  EXPECT_EQ(areas.back().name, "wood-2");
}

TEST_F(RestTest, Areas_with_holes_and_with_names_that_are_taken_are_refused_with_the_place) {
  console.fly();
  const auto reason = [this](const std::string& body) {
    return std::string(json(post("/api/areas", body)).at("reason"));
  };
  const std::string ring = ring_at(0.2);
  const std::string holed =
      fmt::format(R"({{"type":"Polygon","coordinates":[{0},{0}]}})", ring.substr(1, ring.size() - 2));
  EXPECT_EQ(reason(collection("{}", holed)).find("features[0].geometry.coordinates: has 2 rings"), 0U);
  EXPECT_EQ(reason(collection(R"({"name":"east"})", polygon_at(0.2))),
            "features[0]: east is the name of a cluster already; give it another");
  const std::string feature =
      fmt::format(R"({{"type":"Feature","properties":{{"name":"x"}},"geometry":{}}})", polygon_at(0.2));
  EXPECT_EQ(
      reason(fmt::format(
          R"({{"type":"FeatureCollection","vigil":{{"frame":"world","unit":"m"}},"features":[{0},{0}]}})", feature)),
      "features[1]: the name x is there twice; names must differ");
}

TEST_F(RestTest, Commands_are_answered_as_by_websocket_with_the_status_that_says_the_same) {
  console.fly();
  EXPECT_EQ(json(command({{"type", "hold"}, {"id", 4}, {"drones", {"a"}}})).at("id"), 4);
  EXPECT_EQ(status(command({{"type", "ping"}, {"id", 1}})), 200);
  EXPECT_EQ(json(preview({{"seconds", 2}})).at("type"), "preview");
  EXPECT_EQ(status(command({{"type", "hold"}, {"id", 1}, {"drones", {"x"}}})), 404);
  EXPECT_EQ(status(command({{"type", "take_off"}, {"id", 1}, {"drones", {"b"}}})), 409);
  EXPECT_EQ(status(command({{"type", "hold"}})), 400);
  EXPECT_EQ(status(command({{"type", "hello"}})), 400);
  EXPECT_EQ(status(command({{"type", "confirm"}, {"received", 1}})), 400);
  EXPECT_EQ(status(post("/api/commands", "{")), 400);
  EXPECT_EQ(status(post("/api/commands", std::string(kMostMessageBytes + 1, ' '))), 413);
  EXPECT_EQ(console.hub.state().at("drones").at(0).at("activity"), "held");
}

TEST_F(RestTest, Whoever_calls_the_server_by_a_name_that_is_not_its_own_gets_nothing) {
  console.fly();
  for (const char* target : {"/", "/api/state", "/api/version"}) {
    HttpRequest request = get(target);
    request.host = "evil.example";
    EXPECT_EQ(status(request), 421) << target;
  }
}

TEST_F(RestTest, Another_sites_page_may_look_at_nothing_and_change_nothing) {
  console.fly();
  HttpRequest land = command({{"type", "land_all"}, {"id", 1}});
  for (const char* origin : {"http://evil.example", "null", "http://127.0.0.1:9999"}) {
    land.origin = origin;
    EXPECT_EQ(status(land), 403) << origin;
  }
  land.origin = "http://127.0.0.1:8080";
  land.content_type = "text/plain";  // what a form of another site could send
  EXPECT_EQ(status(land), 415);
  EXPECT_EQ(console.hub.state().at("active"), 3);
}

TEST_F(RestTest, What_is_not_there_is_not_found_and_what_is_there_says_how_it_is_asked) {
  console.fly();
  EXPECT_EQ(status(get("/api/nothing")), 404);
  EXPECT_EQ(status(get("/api/commands")), 405);
  EXPECT_EQ(status(post("/api/state", "{}")), 405);
  EXPECT_EQ(status(post("/", "{}")), 405);
  HttpRequest shouted = command({{"type", "ping"}, {"id", 1}});
  shouted.content_type = "Application/JSON; charset=utf-8";
  EXPECT_EQ(status(shouted), 200);
  shouted.target = "/api/why";
  shouted.content_type = "text/plain";
  EXPECT_EQ(status(shouted), 405);  // whatever it brings
  const HttpAnswer answer = ask(get("/api/commands"));
  EXPECT_EQ(answer.headers.back(), std::make_pair(std::string("Allow"), std::string("POST")));
  EXPECT_NE(answer.body->find("answers to POST"), std::string::npos);
  EXPECT_EQ(status(get("/nothing.js")), 404);
  const HttpAnswer unbuilt = ask(get("/"));
  EXPECT_EQ(unbuilt.status, 200);
  EXPECT_NE(unbuilt.body->find("was not built"), std::string::npos);
}

TEST_F(LockedRestTest, A_token_opens_what_its_role_may_and_nothing_opens_more) {
  console.fly();
  EXPECT_EQ(json(get("/api/version")).at("login"), true);
  HttpRequest state = get("/api/state");
  for (const char* header :
       {"", "Bearer ", "Bearer viewer-012345678", "viewer-0123456789", "Basic viewer-0123456789"}) {
    state.authorization = header;
    EXPECT_EQ(status(state), 401) << header;
  }
  for (const char* header : {"Bearer viewer-0123456789", "bearer viewer-0123456789", "BEARER viewer-0123456789"}) {
    state.authorization = header;
    EXPECT_EQ(status(state), 200) << header;
  }
  HttpRequest land = command({{"type", "land_all"}, {"id", 1}});
  land.authorization = "Bearer viewer-0123456789";
  EXPECT_EQ(status(land), 403);
  land.authorization = "Bearer operator-0123456789";
  EXPECT_EQ(status(land), 200);
  HttpRequest stop = command({{"type", "emergency_stop"}, {"id", 1}, {"drones", "all"}});
  stop.authorization = land.authorization;
  EXPECT_EQ(status(stop), 403);
}

/// "GET /api/state 200" for each that protocol/openapi.json describes.
std::set<std::string> described() {
  std::ifstream file(VIGIL_PROTOCOL_DIR "/openapi.json");
  std::set<std::string> all;
  const Json openapi = Json::parse(file);
  for (const auto& [path, methods] : openapi.at("paths").items())
    for (const auto& [method, what] : methods.items())
      for (const auto& [status, answer] : what.at("responses").items())
        all.insert((method == "get" ? "GET " : "POST ") + path + " " + status);
  return all;
}

TEST_F(LockedRestTest, Every_answer_that_is_described_is_given_and_no_other) {
  const auto with = [](HttpRequest request, const std::string& token) {
    request.authorization = "Bearer " + token;
    return request;
  };
  const std::string viewer = "viewer-0123456789";
  const std::string anybody = "operator-0123456789";
  const std::vector<HttpRequest> gets{get("/api/version"), get("/api/state"), get("/api/mission"), get("/api/areas"),
                                      get("/api/why?drone=c")};
  const std::vector<HttpRequest> posts{
      post("/api/areas", kArea), command({{"type", "hold"}, {"id", 1}, {"drones", {"a"}}}), preview({{"seconds", 2}})};
  for (const HttpRequest& request : gets) ask(with(request, anybody));
  EXPECT_EQ(ask(with(posts[0], anybody)).status, 503);
  console.fly();
  console.pass(100ms);
  for (const HttpRequest& request : gets) ask(with(request, viewer));
  for (const HttpRequest& request : posts) ask(with(request, anybody));
  for (const HttpRequest& request : gets) ask(request);
  for (HttpRequest request : posts) {
    ask(request);                // no token
    ask(with(request, viewer));  // the role is too low
    HttpRequest other = with(request, anybody);
    other.content_type = "text/plain";
    ask(other);
    other = with(request, anybody);
    other.origin = "http://evil.example";
    ask(other);
    other = with(request, anybody);
    other.body = "{";
    ask(other);
    other.body = std::string(kMostMessageBytes + 1, ' ');
    ask(other);
  }
  std::vector<HttpRequest> all = gets;
  all.insert(all.end(), posts.begin(), posts.end());
  for (HttpRequest request : all) {
    request.host = "evil.example";
    ask(request);
  }
  ask(with(command({{"type", "hold"}, {"id", 1}, {"drones", {"x"}}}), anybody));
  ask(with(command({{"type", "take_off"}, {"id", 1}, {"drones", {"a"}}}), anybody));
  ask(with(preview({{"without", {"x"}}}), anybody));
  for (const char* target : {"/api/why", "/api/why?drone=x", "/api/state?x", "/api/areas?x", "/api/mission?x"})
    ask(with(get(target), viewer));
  const Json edit{{"op", "set_uniform_floor"}, {"uniform_floor", 0.1}};
  ask(with(preview({{"edits", {edit}}, {"based_on", 99}}), anybody));
  console.most_tasks = 0;  // the desk has no time
  ask(with(posts[2], anybody));
  ask(with(gets.back(), viewer));
  ask(with(posts[0], anybody));
  ask(with(command({{"type", "undo"}, {"id", 1}, {"based_on", 1}}), anybody));
  console.most_tasks = 2;
  rest.answer(with(posts[0], anybody), [](const HttpAnswer&) {});  // another program is faster by a moment
  ask(with(posts[0], anybody));
  console.most_tasks = 256;
  console.is_desk_at_work = false;
  runtime::Mission lone = runtime::small_mission();
  lone.drones.resize(1);
  console.tasks.emplace_back([lone](Desk& desk) { desk.begin(lone, nullptr); });  // before it comes to the question
  rest.answer(with(gets.back(), viewer),
              [this](const HttpAnswer& answer) { given.insert("GET /api/why " + std::to_string(answer.status)); });
  console.is_desk_at_work = true;
  console.pass_until([this] { return given.contains("GET /api/why 409"); });
  std::vector<std::string> differing;
  std::ranges::set_symmetric_difference(given, described(), std::back_inserter(differing));
  EXPECT_EQ(differing, std::vector<std::string>{});
}

TEST(JsonMembers, One_that_is_there_twice_is_named_wherever_it_is) {
  const auto reason = [](std::string_view text) {
    const auto parsed = parse_client_message(text);
    const auto* refusal = std::get_if<MessageRefusal>(&parsed);
    return refusal == nullptr ? "" : refusal->reason;
  };
  EXPECT_EQ(reason(R"({"type":"land","id":1,"drones":["a"],"drones":["b"]})"),
            "drones: is there twice in one object; give it once");
  EXPECT_EQ(reason(R"({"type":"editing","id":1,"what":[{"kind":"area","name":"a","name":"b"}]})"),
            "name: is there twice in one object; give it once");
  EXPECT_EQ(reason(R"({"type":"editing","id":1,"what":[{"kind":"area","name":"a"},{"kind":"area","name":"b"}]})"), "");
  const auto preview = parse_preview(R"({"seconds":10,"seconds":20})");
  EXPECT_EQ(std::get<MessageRefusal>(preview).reason, "seconds: is there twice in one object; give it once");
  const auto areas = edits_of_geojson(R"({"type":"FeatureCollection","features":[],"features":[]})", {});
  EXPECT_EQ(std::get<std::string>(areas), "features: is there twice in one object; give it once");
}

TEST(JsonMembers, The_refusal_of_one_that_is_there_twice_has_the_id_where_that_is_there_once) {
  const auto id = [](std::string_view text) {
    const auto parsed = parse_client_message(text);
    return std::get<MessageRefusal>(parsed).id;
  };
  EXPECT_EQ(id(R"({"type":"land","id":5,"drones":["a"],"drones":["b"]})"), 5U);
  EXPECT_EQ(id(R"({"type":"ping","id":5,"id":6})"), std::nullopt);
}

}  // namespace
}  // namespace vigil::console
