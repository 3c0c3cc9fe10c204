// A kind of measurement other than radio: thermometers in a room, diagnosed by the same engine. A site is a time, a
// group a thermometer.
#pragma once

#include <cmath>
#include <numeric>

#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/causes/parameter_axes.hpp"
#include "diagnosis/inference/assess/search.hpp"
#include "diagnosis/inference/state/smooths.hpp"
#include "diagnosis/prediction/sensitivities.hpp"
#include "text/text_table.hpp"

namespace muster::thermometers {

using Eigen::Index;
using Eigen::VectorXd;

// The sets of such a world: data to the kernel, as the standard ones are.
inline const Standard& sets() {
  static const Standard result{
      {{"thermometer", SetKind::fixed, "", "thermometers", {}},
       {"sample",
        SetKind::listed,
        "",
        "measured samples",
        {{"at", "t[s] thermometer:thermometer", "", false, ""}, {"temperature", "temperature[K]", "", false, ""}}}},
      {{"thermometer", "thermometer", "a thermometer", "", {}, ""}}};
  return result;
}

struct Samples {
  VectorXd t, temperature, humidity;  // s, K, %
  std::vector<int> thermometer;       // from 0
  std::vector<std::string> names;

  explicit Samples(const TextTable& table) {
    const auto column = [&](const char* name) {
      const std::vector<double> v = table.reals(*table.find(name));
      return VectorXd(Eigen::Map<const VectorXd>(v.data(), static_cast<Index>(v.size())));
    };
    t = column("t");
    temperature = column("temperature");
    humidity = column("humidity");
    const Factor factor = table.texts(*table.find("thermometer"));
    thermometer.assign(factor.level.begin(), factor.level.end());
    names = factor.levels;
  }
};

// Rows: half an hour of one thermometer. Sites: hours.
class SampleLayout : public inference::Layout {
 public:
  explicit SampleLayout(const Samples& samples) : samples_(samples) {}

  Index size() const override { return samples_.t.size(); }
  noise::Rows rows() const override {
    std::vector<Index> order(samples_.thermometer.size()), first;
    std::iota(order.begin(), order.end(), 0);
    const auto of = [&](Index i) { return samples_.thermometer[static_cast<std::size_t>(i)]; };
    std::stable_sort(order.begin(), order.end(), [&](Index a, Index b) {
      return std::pair(of(a), samples_.t[a]) < std::pair(of(b), samples_.t[b]);
    });
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (k == 0 || of(order[k]) != of(order[k - 1]) ||
          samples_.t[order[k]] - samples_.t[order[static_cast<std::size_t>(first.back())]] >= 1800)
        first.push_back(static_cast<Index>(k));
    }
    first.push_back(static_cast<Index>(order.size()));
    return {std::move(order), std::move(first)};
  }
  noise::Sites sites(const noise::Rows& rows) const override {
    const Eigen::Matrix3Xd zero = Eigen::Matrix3Xd::Zero(3, rows.size());
    noise::Sites result{zero, zero, zero, zero, {}, rows.count()};
    result.place.row(0) = rows.mean(samples_.t).transpose() / 3600;
    for (Index i = 0; i < rows.size(); ++i) {
      const Index a = rows.example(i), b = rows.last(i);
      result.place_stretch(0, i) = (samples_.t[b] - samples_.t[a]) / 3600 / 3 / noise::mean_of_three;
      result.group.push_back(samples_.thermometer[static_cast<std::size_t>(a)]);
    }
    return result;
  }

 private:
  const Samples& samples_;
};

inline std::vector<inference::Candidate> smooths_of(const Samples& s) {
  std::vector<inference::Candidate> result{
      inference::smooth_of("time", s.t, 8), inference::factor("thermometer", s.thermometer),
      inference::smooth_by_level("time_per_thermometer", s.thermometer, inference::cosines(s.t, 5)),
      inference::smooth_of("humidity", s.humidity, 5), inference::bend("humidity", s.humidity)};
  result[0].role.time_like = true;
  result[3].role.observed = true;
  return result;
}

class ThermometerDomain : public diagnosis::CauseDomain {
 public:
  explicit ThermometerDomain(const Samples& samples) : samples_(samples) {}

  std::string why_not(const diagnosis::Cause& /*cause*/) const override { return ""; }
  std::vector<diagnosis::CauseRow> rows_for(const diagnosis::Cause& cause) const override {
    if (cause.rows().empty()) return {{}};
    std::vector<diagnosis::CauseRow> result;
    for (const std::string& name : samples_.names) result.push_back({name});
    return result;
  }
  std::optional<diagnosis::Axis> axis_of(const muster_param& p, const diagnosis::CauseShape& shape,
                                         bool alone) const override {
    if (p.flags & MUSTER_LOG) return diagnosis::logarithmic(p, p.min, p.max, {900, 1800, 3600, 7200, 14400}, 0.2);
    return diagnosis::axis_over(p, diagnosis::Span{samples_.t.minCoeff(), samples_.t.maxCoeff()}, shape, alone);
  }
  void describe(const diagnosis::CauseShape& shape, inference::Candidate& c) const override {
    const bool in_time = std::string_view(shape.cause.meaning().covariates) == "t";
    c.covariates = {in_time ? "time" : "thermometer"};
    c.role.replaces = in_time ? std::set<std::string>{"time", "time_per_thermometer"} : std::set{c.covariates[0]};
    c.role.time_like = in_time && shape.rows.size() == 1;
    c.role.slow = !in_time;
    c.refinement.evaluations = 40;
    c.refinement.charge = 1;
  }

 private:
  const Samples& samples_;
};

}  // namespace muster::thermometers
