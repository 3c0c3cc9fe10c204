#include "diagnosis/radio/links/drawn_term.hpp"

#include <algorithm>
#include <array>
#include <map>

namespace muster::diagnosis {
namespace {

std::size_t number_of(const Instance& instance, const char* parameter) {
  const int k = instance.find_param(parameter);
  if (k < 0)
    throw instance.refused("muster_draw names the parameter '" + std::string(parameter) +
                           "', which it does not declare");
  return static_cast<std::size_t>(k);
}

const Instance* drawing(const LinkModel& model) {
  const Instance* result = nullptr;
  for (const auto& instance : model.simulation().instances()) {
    const muster_draw* draw = instance->plugin().draw;
    if (draw && instance->params()[number_of(*instance, draw->scale)] > 0) result = instance.get();
  }
  return result;
}

using Ends = Eigen::Matrix<double, 6, Eigen::Dynamic>;

// Pairs of links, those between the same places once. Radios that stand give a few links many readings.
class DistinctPairs {
 public:
  DistinctPairs(const Ends& ends, const std::vector<uint32_t>& a, const std::vector<uint32_t>& b) {
    std::map<std::array<double, 6>, uint32_t> known;
    std::vector<uint32_t> link;
    for (Eigen::Index i = 0; i < ends.cols(); ++i) {
      std::array<double, 6> at;
      Eigen::Map<Eigen::Matrix<double, 6, 1>>(at.data()) = ends.col(i);
      link.push_back(known.try_emplace(at, static_cast<uint32_t>(known.size())).first->second);
    }
    const std::size_t links = known.size();
    if (links * links > a.size()) return;  // hardly any pair comes twice
    constexpr uint32_t none = ~uint32_t{0};
    std::vector<uint32_t> number(links * links, none);
    for (std::size_t i = 0; i < a.size(); ++i) {
      uint32_t& pair = number[link[a[i]] * links + link[b[i]]];
      if (pair == none) {
        pair = static_cast<uint32_t>(a_.size());
        a_.push_back(a[i]), b_.push_back(b[i]);
      }
      of_.push_back(pair);
    }
  }

  bool found() const { return !of_.empty(); }
  const std::vector<uint32_t>& a() const { return a_; }
  const std::vector<uint32_t>& b() const { return b_; }
  void spread(const std::vector<double>& values, double* out) const {
    for (std::size_t i = 0; i < of_.size(); ++i) out[i] = values[of_[i]];
  }

 private:
  std::vector<uint32_t> a_, b_, of_;  // of each pair that was given: its number
};

class DrawnTerm : public noise::StatedCorrelation {
 public:
  explicit DrawnTerm(const Instance& instance)
      : library_(instance.library()),
        draw_(*instance.plugin().draw),
        params_(instance.params()),
        distance_(number_of(instance, draw_.distance)) {
    params_[number_of(instance, draw_.scale)] = 1;
  }

  void covariances(const noise::Sites& sites, double decorrelation, const std::vector<uint32_t>& a,
                   const std::vector<uint32_t>& b, double* out) const override {
    Ends ends(6, sites.size());
    ends << sites.place, sites.anchor;
    std::vector<double> params = params_;
    params[distance_] = decorrelation;
    const auto ask = [&](const auto& one, const auto& other, double* to) {
      draw_.covariance(params.data(), ends.data(), one.data(), other.data(), static_cast<uint32_t>(one.size()), to);
    };
    const DistinctPairs pairs(ends, a, b);
    if (!pairs.found()) return ask(a, b, out);
    std::vector<double> values(pairs.a().size());
    ask(pairs.a(), pairs.b(), values.data());
    pairs.spread(values, out);
  }

 private:
  std::shared_ptr<Library> library_;
  const muster_draw& draw_;
  std::vector<double> params_;
  std::size_t distance_;
};

}  // namespace

std::shared_ptr<const noise::StatedCorrelation> drawn_correlation(const LinkModel& model) {
  const Instance* instance = drawing(model);
  return instance ? std::make_shared<const DrawnTerm>(*instance) : nullptr;
}

noise::StatedField drawn_field(const LinkModel& model) {
  const Instance* instance = drawing(model);
  if (!instance) return {};
  const muster_draw& draw = *instance->plugin().draw;
  return {instance->params()[number_of(*instance, draw.scale)],
          instance->params()[number_of(*instance, draw.distance)]};
}

bool set_drawn_field(LinkModel& model, const noise::StatedField& field) {
  const Instance* instance = drawing(model);
  if (!instance) return false;
  const muster_draw draw = *instance->plugin().draw;
  const std::string name = instance->name();
  for (const auto& [parameter, value] :
       {std::pair(draw.scale, field.shadowing), {draw.distance, field.decorrelation}}) {
    const std::string path = name + '/' + parameter;
    const muster_param& declared = *model.parameter(path).declared;
    model.set(path, std::clamp(value, declared.min, declared.max));
  }
  return true;
}

bool declares_draws(const LinkModel& model) {
  const auto& all = model.simulation().instances();
  return std::any_of(all.begin(), all.end(), [](const auto& i) { return i->plugin().draw != nullptr; });
}

}  // namespace muster::diagnosis
