#include <benchmark/benchmark.h>

#include "build_record.hpp"

/// Runs the benchmarks of the program it is linked with; their report says what was built, of what and by what.
int main(int argc, char** argv) {
  benchmark::AddCustomContext("commit", vigil::bench::kCommit);
  benchmark::AddCustomContext("compiler", vigil::bench::kCompiler);
  benchmark::AddCustomContext("flags", vigil::bench::kFlags);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  const auto benchmarks_run = benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return benchmarks_run == 0 ? 1 : 0;
}
