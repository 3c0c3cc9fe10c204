#include "diagnosis/radio/links/drawn_term.hpp"

#include <algorithm>

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
    Eigen::Matrix<double, 6, Eigen::Dynamic> ends(6, sites.size());
    ends << sites.place, sites.anchor;
    std::vector<double> params = params_;
    params[distance_] = decorrelation;
    draw_.covariance(params.data(), ends.data(), a.data(), b.data(), static_cast<uint32_t>(a.size()), out);
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
