#pragma once

#include "exam/case.hpp"
#include "exam/case_spec.hpp"
#include "exam/true_whitener.hpp"
#include "exam/write.hpp"

namespace muster::exam {

// A case with one effect ("" for none).
inline Case made(std::uint64_t seed, const std::string& effect, double lambda = 60, int rows = 1500) {
  Order order;
  order.rows = rows;
  order.kind = effect.empty() ? "clean" : recipe(effect).in_vocabulary ? "one" : "outside";
  if (!effect.empty()) order.effects = {effect};
  if (!effect.empty()) order.lambdas = {lambda};
  return make_case("case_0001", seed, order);
}

inline Eigen::VectorXd level_by_base(const Case& c, const Data& data) { return data.design * coefficients(*c.site); }

inline std::string everything(const Case& c) {
  return world_xml(c) + walls_csv(c.site->plan) + readings_csv(*c.site, c.measured) + readings_csv(*c.site, c.second) +
         answer_json(c);
}

}  // namespace muster::exam
