#include "vigil/adapters/report/gnuplot.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <fstream>
#include <iterator>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "vigil/adapters/report/report_error.hpp"

namespace vigil::report {
namespace {

constexpr const char* kScript = "figures.gp";
constexpr const char* kLog = "gnuplot.log";

std::string script_of(const std::vector<Figure>& figures) {
  std::string script = "set encoding utf8\nset minussign\n";
  for (const Figure& figure : figures) script += figure.data;
  for (const Figure& f : figures) {
    script += fmt::format(
        "reset\nset term svg noenhanced size {},{} font 'sans-serif,13' butt dashlength 0.5\nset output "
        "'{}.svg'\n{}\nunset output\n",
        f.width_px, f.height_px, f.name, f.commands);
    script += fmt::format(
        "reset\nset term pngcairo noenhanced size {},{} font 'sans-serif,10' fontscale 2 linewidth 2 pointscale 2 "
        "dashlength 0.7 background "
        "'#ffffff'\nset output '{}.png'\n{}\nunset output\n",
        2 * f.width_px, 2 * f.height_px, f.name, f.commands);
  }
  return script;
}

/// What a child process starts with: its folder, and files in place of its three streams.
class SpawnActions {
 public:
  explicit SpawnActions(const std::filesystem::path& folder) {
    posix_spawn_file_actions_init(&actions_);
    posix_spawn_file_actions_addchdir_np(&actions_, folder.c_str());
    posix_spawn_file_actions_addopen(&actions_, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions_, STDERR_FILENO, kLog, O_WRONLY | O_CREAT | O_TRUNC, 0644);
    posix_spawn_file_actions_adddup2(&actions_, STDERR_FILENO, STDOUT_FILENO);
  }
  ~SpawnActions() { posix_spawn_file_actions_destroy(&actions_); }
  SpawnActions(const SpawnActions&) = delete;
  SpawnActions& operator=(const SpawnActions&) = delete;
  [[nodiscard]] const posix_spawn_file_actions_t* get() const { return &actions_; }

 private:
  posix_spawn_file_actions_t actions_{};
};

int wait_for(pid_t child) {
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128;
}

int run(std::string program, const std::filesystem::path& folder) {
  std::string defaults = "--default-settings";
  std::string script = kScript;
  const std::array<char*, 4> arguments{program.data(), defaults.data(), script.data(), nullptr};
  const SpawnActions actions(folder);
  pid_t child = 0;
  const int error = ::posix_spawnp(&child, program.c_str(), actions.get(), nullptr, arguments.data(), environ);
  if (error != 0) {
    throw GnuplotMissing(
        fmt::format("{}: cannot start it to draw the figures: {}; install it: apt-get install gnuplot-nox", program,
                    std::strerror(error)));
  }
  return wait_for(child);
}

std::string log_of(const std::filesystem::path& folder) {
  constexpr std::size_t kLongest = 400;
  std::ifstream file(folder / kLog);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  for (char& c : text) c = c == '\n' || c == '\t' ? ' ' : c;
  return text.substr(0, kLongest);
}

void require_files(const std::vector<Figure>& figures, const std::filesystem::path& folder) {
  for (const Figure& figure : figures) {
    for (const char* extension : {".svg", ".png"}) {
      std::error_code error;
      const std::uintmax_t bytes = std::filesystem::file_size(folder / (figure.name + extension), error);
      if (error || bytes == 0) {
        throw ReportError(fmt::format("{}{}: gnuplot did not draw it: {}; check that there is room on the disk",
                                      figure.name, extension, log_of(folder)));
      }
    }
  }
}

}  // namespace

std::string literal(std::string_view text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'')
      out += "\u2019";  // a quote inside quotes confuses gnuplot at either end
    else if (c == '\\' || c == '`' || c == '@' || static_cast<unsigned char>(c) < ' ' || c == '\x7f')
      out += '_';
    else
      out += c;
  }
  return out + "'";
}

void draw(const std::vector<Figure>& figures, const std::filesystem::path& folder, const std::string& gnuplot) {
  {
    std::ofstream file(folder / kScript, std::ios::binary);
    file << script_of(figures);
    if (!file.flush())
      throw ReportError(fmt::format("{}: cannot write it; choose a folder with room", (folder / kScript).string()));
  }
  if (const int status = run(gnuplot, folder); status != 0) {
    throw ReportError(fmt::format("gnuplot ended with status {}: {}", status, log_of(folder)));
  }
  require_files(figures, folder);
}

}  // namespace vigil::report
