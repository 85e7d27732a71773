#include "vigil/runtime/saved_flight.hpp"

#include <cmath>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <limits>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "vigil/swarm/names.hpp"

namespace vigil::runtime {
namespace {

using nlohmann::json;

constexpr int kFormat = 2;
constexpr int kFormatWithoutOrders = 1;  ///< is still read
constexpr const char* kFile = "flight.json";
constexpr std::uintmax_t kMostBytes = std::uintmax_t{256} << 20U;

json in_json(const ergodic::Coefficients& numbers) {
  return {{"rows", numbers.rows()}, {"values", std::vector<double>(numbers.data(), numbers.data() + numbers.size())}};
}

ergodic::Coefficients coefficients_in(const json& value) {
  const auto values = value.at("values").get<std::vector<double>>();
  const auto rows = value.at("rows").get<Eigen::Index>();
  const auto size = static_cast<Eigen::Index>(values.size());
  if (rows < 0 || (rows == 0 ? size != 0 : size % rows != 0)) throw SavedFlightError("coefficients of no shape");
  if (rows == 0) return {};
  return Eigen::Map<const ergodic::Coefficients>(values.data(), rows, size / rows);
}

/// JSON knows no infinity; what was never seen is null there.
json seen_in_json(const std::vector<double>& seen_s) {
  json list = json::array();
  for (const double seen : seen_s) list.push_back(std::isfinite(seen) ? json(seen) : json(nullptr));
  return list;
}

std::vector<double> seen_in(const json& list) {
  std::vector<double> seen_s;
  for (const json& seen : list)
    seen_s.push_back(seen.is_null() ? -std::numeric_limits<double>::infinity() : seen.get<double>());
  return seen_s;
}

swarm::Intent order_in(const json& word) {
  const auto order = swarm::value_of<swarm::Intent>(word.get<std::string>());
  if (!order) throw SavedFlightError("an order that there is not");
  return *order;
}

SavedFlight::Drone drone_in(const json& drone, bool has_order) {
  return {.place_m = {drone.at(0).get<double>(), drone.at(1).get<double>()},
          .is_down = drone.at(2).get<bool>(),
          .order = has_order ? order_in(drone.at(3)) : swarm::Intent::kHold};
}

SavedFlight read(const json& saved) {
  const int format = saved.at("format").get<int>();
  if (format != kFormat && format != kFormatWithoutOrders)
    throw SavedFlightError("written by another version of the program");
  SavedFlight flight;
  flight.mission_text = saved.at("mission").get<std::string>();
  flight.targets_text = saved.at("targets").get<std::string>();
  flight.revision = saved.at("revision").get<std::uint64_t>();
  flight.past.ticks = saved.at("ticks").get<std::uint64_t>();
  flight.past.has_first_metric = saved.at("has_first_metric").get<bool>();
  flight.past.first_metric = saved.at("first_metric").get<double>();
  const json& coverage = saved.at("coverage");
  flight.past.coverage = {.sum = coefficients_in(coverage.at("sum")),
                          .time_s = coverage.at("time_s").get<double>(),
                          .past_averages = coefficients_in(coverage.at("past_averages")),
                          .has_samples = coverage.at("has_samples").get<bool>()};
  flight.seen_s = seen_in(saved.at("seen_s"));
  for (const json& drone : saved.at("drones")) flight.drones.push_back(drone_in(drone, format == kFormat));
  return flight;
}

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& problem, const std::string& advice) {
  throw SavedFlightError(fmt::format("{}: {}; {}", path.string(), problem, advice));
}

/// Writes and flushes a file; false where anything of it failed.
bool write_through(const std::filesystem::path& path, const std::string& text) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) return false;
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(file, text.data() + written, text.size() - written);
    if (count <= 0) break;
    written += static_cast<std::size_t>(count);
  }
  const bool is_flushed = ::fsync(file) == 0;
  return ::close(file) == 0 && is_flushed && written == text.size();
}

/// Flushes which files a folder has; false where that failed.
bool flush_folder(const std::filesystem::path& folder) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool is_flushed = ::fsync(descriptor) == 0;
  return ::close(descriptor) == 0 && is_flushed;
}

}  // namespace

std::string saved_text(const SavedFlight& flight) {
  const swarm::SwarmPast& past = flight.past;
  json drones = json::array();
  for (const SavedFlight::Drone& drone : flight.drones)
    drones.push_back({drone.place_m.x(), drone.place_m.y(), drone.is_down, swarm::name_of(drone.order)});
  const json saved{{"format", kFormat},
                   {"mission", flight.mission_text},
                   {"targets", flight.targets_text},
                   {"revision", flight.revision},
                   {"ticks", past.ticks},
                   {"has_first_metric", past.has_first_metric},
                   {"first_metric", past.first_metric},
                   {"coverage",
                    {{"sum", in_json(past.coverage.sum)},
                     {"time_s", past.coverage.time_s},
                     {"past_averages", in_json(past.coverage.past_averages)},
                     {"has_samples", past.coverage.has_samples}}},
                   {"seen_s", seen_in_json(flight.seen_s)},
                   {"drones", std::move(drones)}};
  return saved.dump() + "\n";
}

SavedFlight saved_flight(const std::string& text) {
  try {
    return read(json::parse(text));
  } catch (const json::exception& error) {
    throw SavedFlightError(fmt::format("it is not what vigil writes ({})", error.what()));
  }
}

FlightStore::FlightStore(std::filesystem::path folder) : folder_(std::move(folder)) {
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) fail(folder_, "cannot be made (" + error.message() + ")", "name a folder where you may write");
  try {
    lock_ = FolderLock::take(folder_);
  } catch (const std::system_error& problem) {
    fail(folder_, "cannot be locked (" + problem.code().message() + ")",
         "name a folder of a local disk where you may write");
  }
  if (!lock_) fail(folder_, "another vigil keeps its state there", "end that one first, or name another folder");
}

std::optional<SavedFlight> FlightStore::load() const {
  const std::filesystem::path path = folder_ / kFile;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error || size > kMostBytes) fail(path, "is no file of a reasonable size", "remove it to begin anew");
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file || text.size() != size) fail(path, "cannot be read", "give yourself the right to, or remove it");
  try {
    return saved_flight(text);
  } catch (const SavedFlightError& problem) {
    fail(path, problem.what(), "remove it to begin anew");
  }
}

void FlightStore::save(const SavedFlight& flight) const {
  const std::filesystem::path path = folder_ / kFile;
  std::filesystem::path unfinished = path;
  unfinished += ".unfinished";
  std::error_code error;
  if (write_through(unfinished, saved_text(flight)))
    std::filesystem::rename(unfinished, path, error);
  else
    error = std::make_error_code(std::errc::io_error);
  if (error || !flush_folder(folder_)) fail(path, "cannot be written", "make room, or name another folder");
}

void FlightStore::clear() const {
  std::error_code ignored;
  std::filesystem::remove(folder_ / kFile, ignored);
}

}  // namespace vigil::runtime
