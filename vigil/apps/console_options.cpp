#include "vigil/apps/console_options.hpp"

#include <system_error>

#include <fmt/format.h>

#include "vigil/adapters/console/access.hpp"
#include "vigil/apps/exit_code.hpp"
#include "vigil/apps/failure.hpp"
#include "vigil/runtime/mission_error.hpp"

namespace vigil::apps {
namespace {

namespace fs = std::filesystem;

fs::path built_page() {
  std::error_code error;
  const fs::path installed = fs::read_symlink("/proc/self/exe", error).parent_path() / "../share/vigil/web";
  return fs::is_directory(installed, error) ? installed : fs::path(VIGIL_PAGE_DIR);
}

}  // namespace

void check_console(const ConsoleOptions& options) {
  if (!console::is_loopback(options.address) && options.tokens.empty())
    throw Failure(kBadInput,
                  fmt::format("--address {}: others can reach it, so --tokens FILE is needed, with lines of a role "
                              "(viewer, operator, safety_pilot) and a token; make one with: openssl rand -hex 24",
                              runtime::on_one_line(options.address, 60)));
  if (options.certificate.empty() != options.key.empty())
    throw Failure(kBadInput, "--certificate and --key belong together; give both, or none");
}

void warn_of_readers(const ConsoleOptions& options) {
  if (options.tokens.empty() || !options.certificate.empty() || console::is_loopback(options.address)) return;
  fmt::print(
      "vigil: warning: without TLS whoever is on the way can read the tokens and give orders with them; give "
      "--certificate and --key, or serve on 127.0.0.1 behind something that encrypts\n");
}

console::ServerOptions server_options(const ConsoleOptions& options, const std::string& version) {
  console::ServerOptions result;
  result.address = options.address;
  result.port = options.port;
  result.names = options.names;
  if (!options.tokens.empty()) result.tokens = console::Tokens::read(options.tokens);
  result.certificate = options.certificate;
  result.key = options.key;
  result.page = options.page.empty() ? built_page() : options.page;
  result.program = "vigil " + version;
  return result;
}

}  // namespace vigil::apps
