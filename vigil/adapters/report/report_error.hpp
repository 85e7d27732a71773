#pragma once

#include <stdexcept>

namespace vigil::report {

/// A report that cannot be written: one line with what, where and what to do.
class ReportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The program that draws the figures is not there: a missing component, not a bad flight.
class GnuplotMissing : public ReportError {
 public:
  using ReportError::ReportError;
};

}  // namespace vigil::report
