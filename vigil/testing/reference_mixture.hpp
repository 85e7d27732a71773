#pragma once

// For tests: the reference files of vigil/testing/reference and the mixture of Gaussians that they are about.

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "vigil/core/ergodic/basis.hpp"

namespace vigil::ergodic {

inline nlohmann::json reference_file(const std::string& name) {
  std::ifstream file(std::string(VIGIL_REFERENCE_DIR) + "/" + name);
  return nlohmann::json::parse(file);
}

inline Vec2 vec2(const nlohmann::json& pair) { return {pair.at(0).get<double>(), pair.at(1).get<double>()}; }

inline std::vector<Vec2> vec2s(const nlohmann::json& pairs) {
  std::vector<Vec2> result;
  for (const auto& pair : pairs) result.push_back(vec2(pair));
  return result;
}

/// The files' order, k1 fastest, is that of Coefficients; the files count the indices of an axis, K + 1.
inline Coefficients coefficients(const nlohmann::json& numbers) {
  const auto flat = numbers.get<std::vector<double>>();
  const auto side = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(flat.size()))));
  return Eigen::Map<const Coefficients>(flat.data(), side, side);
}

struct ReferenceMixture {
  field::Field field;
  std::vector<field::Gaussian> gaussians;
  std::vector<double> weights;
};

/// From an object with L, gmm_means, gmm_covs and gmm_weights.
inline ReferenceMixture reference_mixture(const nlohmann::json& problem) {
  ReferenceMixture mixture;
  mixture.field = {problem.at("L").at(0).get<double>(), problem.at("L").at(1).get<double>()};
  mixture.weights = problem.at("gmm_weights").get<std::vector<double>>();
  for (std::size_t i = 0; i < mixture.weights.size(); ++i) {
    field::Gaussian gaussian{.mean = vec2(problem.at("gmm_means").at(i)), .covariance = Eigen::Matrix2d::Zero()};
    for (int column = 0; column < 2; ++column) {
      gaussian.covariance.col(column) = vec2(problem.at("gmm_covs").at(i).at(static_cast<std::size_t>(column)));
    }
    mixture.gaussians.push_back(gaussian);
  }
  return mixture;
}

}  // namespace vigil::ergodic
