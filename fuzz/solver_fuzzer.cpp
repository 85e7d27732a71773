// Problems of every size for the planar solver: whatever finite numbers they are made of, the velocity is finite and
// within the disk; where the numbers are of a size that drones meet, the answer is the slow solver's.

#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "vigil/core/safety/planar_qp.hpp"
#include "vigil/testing/random_planar_qp.hpp"

namespace {

using vigil::Vec2;
using vigil::safety::HalfPlane;
using vigil::safety::PlanarProblem;

/// Reads numbers off the fuzzer's bytes; zeros when they run out.
class Reader {
 public:
  Reader(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  [[nodiscard]] bool is_empty() const { return at_ >= size_; }
  std::uint8_t byte() { return is_empty() ? std::uint8_t{0} : data_[at_++]; }

  /// Any finite double, bit by bit.
  double any() {
    double value = 0.0;
    const std::size_t taken = std::min(sizeof value, size_ - at_);
    std::memcpy(&value, data_ + at_, taken);
    at_ += taken;
    return std::isfinite(value) ? value : 0.0;
  }

  /// A number of a drone's size, in steps that hit zero, equality and opposites often.
  double tame() { return static_cast<double>(static_cast<std::int8_t>(byte())) / 64.0 + 1e-4 * (byte() % 4); }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
};

PlanarProblem read_problem(Reader& reader, bool is_tame) {
  const auto number = [&] { return is_tame ? reader.tame() : reader.any(); };
  PlanarProblem problem;
  problem.radius = std::abs(number());
  problem.u_nom = Vec2(number(), 0.0);
  problem.u_nom.y() = number();
  const std::size_t most_rows = is_tame ? 12 : vigil::safety::kMaxRows;
  while (!reader.is_empty() && problem.rows.size() < most_rows) {
    HalfPlane row;
    row.normal.x() = number();
    row.normal.y() = number();
    row.offset = number();
    if (is_tame && row.normal.isZero()) row.normal.x() = 1.0;  // the slow solver leaves rows without a normal out
    row.priority = static_cast<vigil::safety::Priority>(reader.byte() % vigil::safety::kPriorities);
    problem.rows.push_back(row);
  }
  return problem;
}

void require(bool holds, const char* what, const PlanarProblem& problem) {
  if (holds) return;
  std::fprintf(stderr, "%s\n%s", what, vigil::safety::to_string(problem).c_str());
  std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Reader reader(data, size);
  const bool is_tame = reader.byte() % 2 == 0;
  const PlanarProblem problem = read_problem(reader, is_tame);
  const auto solution = vigil::safety::solve(problem.u_nom, problem.rows, problem.radius);
  require(solution.u.allFinite(), "the velocity is not finite", problem);
  require(solution.u.stableNorm() <= problem.radius * (1.0 + 1e-15), "the velocity is outside the disk", problem);
  for (const double violation : solution.violation) require(violation >= 0.0, "a violation is negative", problem);
  if (is_tame)
    require(compare(problem, solution) != vigil::safety::Agreement::kDifferent, "not the slow solver's answer",
            problem);
  return 0;
}
