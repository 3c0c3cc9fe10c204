#include "diagnosis/pipeline/joint_refit.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

#include "diagnosis/causes/cause_candidates.hpp"
#include "diagnosis/inference/noise/basis.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

struct Unknown {
  std::string path;
  double lower, upper;
  CauseValue* value;  // null for a parameter of the world
  bool log = false;   // its scale is logarithmic
};

class Joint {
 public:
  Joint(const JointRefit& fit, Diagnosis& found)
      : fit_(fit), found_(found), whitener_(fit.state.field(), fit.state.fit.covariance) {
    MatrixXd smooths(fit.state.rows().size(), 0);
    for (const inference::Term& term : fit.state.terms) {
      if (!term.smooth()) continue;
      smooths.conservativeResize(Eigen::NoChange, smooths.cols() + term.columns.cols());
      smooths.rightCols(term.columns.cols()) = term.columns;
    }
    smooths_ = noise::basis_of(whitener_(smooths));
  }

  ~Joint() {
    // An error of a removal is dropped: the one in flight is more informative.
    try {
      for (const std::string& name : inserted_) fit_.model.simulation().remove(name);
    } catch (const Error&) {
    }
  }
  Joint(const Joint&) = delete;
  Joint& operator=(const Joint&) = delete;

  void add_parameters(const std::vector<std::string>& paths, const VectorXd& lower, const VectorXd& upper) {
    for (std::size_t j = 0; j < paths.size(); ++j)
      unknown_.push_back({paths[j], lower[static_cast<Index>(j)], upper[static_cast<Index>(j)], nullptr});
  }

  void add_causes() {
    int number = 0;
    for (CauseEstimate& found : found_.causes) {
      const auto cause =
          std::find_if(fit_.causes.begin(), fit_.causes.end(), [&](const Cause& c) { return c.id == found.id; });
      if (found.status != inference::Status::named || cause == fit_.causes.end()) continue;
      const std::string name = "found" + std::to_string(number++);
      fit_.model.simulation().share(cause->library);
      fit_.model.simulation().insert(declared(found, *cause, name));
      inserted_.push_back(name);
      if (!shifts_levels(*cause)) continue;
      const bool whole = cause->linear().empty();
      for (CauseValue& v : found.values) {
        const unsigned flags = cause->parameter(v.name).flags;
        if (whole || flags & MUSTER_LINEAR)
          unknown_.push_back({name + '/' + v.name, v.minimum, v.maximum, &v, (flags & MUSTER_LOG) != 0});
      }
    }
  }

  void solve() {
    VectorXd x = start(), here = residual(x);
    for (int round = 0; round < 8; ++round) {
      const VectorXd step = slopes(x, here).colPivHouseholderQr().solve(-here);
      double share = 1;
      bool better = false;
      for (int shorter = 0; shorter < 6 && !better; ++shorter, share /= 3) {
        const VectorXd next = inside(x + share * step), there = residual(next);
        better = there.squaredNorm() < here.squaredNorm() - 1e-9;
        if (!better) continue;
        const double won = here.squaredNorm() - there.squaredNorm();
        x = next;
        here = there;
        if (won < 1e-3) round = 8;  // of the deviance
      }
      if (!better) break;
    }
    set(x);
    store(x);
  }

  // Expected level of every reading in the world with the causes, dBm.
  const VectorXd& mean() const { return fit_.model.expected(); }

 private:
  InstanceDeclaration declared(const CauseEstimate& found, const Cause& cause, const std::string& name) const {
    const Place place{fit_.model.simulation().world().file.string()};
    InstanceDeclaration result{cause.id, name, 1, {}, {}, {}, place};
    const auto give = [&](const std::string& attribute, const std::string& value) {
      result.attributes.push_back({attribute, value, place, place});
    };
    if (!found.row.empty()) give(found.row_parameter, found.row);
    for (const auto& [attribute, word] : found.words) give(attribute, word);
    for (const auto& [attribute, text] : found.files) give(attribute, std::filesystem::absolute(fit_.data).string());
    for (const auto& [attribute, value] : found.held) give(attribute, print_real(value));
    for (const CauseValue& v : found.values) give(v.name, print_real(v.value));
    return result;
  }

  VectorXd start() const {
    VectorXd x(static_cast<Index>(unknown_.size()));
    for (std::size_t j = 0; j < unknown_.size(); ++j)
      x[static_cast<Index>(j)] = unknown_[j].value ? unknown_[j].value->value : found_.parameters.at(unknown_[j].path);
    return inside(x);
  }
  VectorXd inside(VectorXd x) const {
    for (std::size_t j = 0; j < unknown_.size(); ++j)
      x[static_cast<Index>(j)] = std::clamp(x[static_cast<Index>(j)], unknown_[j].lower, unknown_[j].upper);
    return x;
  }
  // The guard restores the world's parameters; those of causes end with their instances.
  void set(const VectorXd& x) const {
    for (std::size_t j = 0; j < unknown_.size(); ++j) {
      const double value = x[static_cast<Index>(j)];
      unknown_[j].value ? fit_.model.set(unknown_[j].path, value) : fit_.moved.set(unknown_[j].path, value);
    }
  }
  // Simulated minus measured, whitened, with the smooths projected out.
  VectorXd residual(const VectorXd& x) const {
    set(x);
    const VectorXd mean = fit_.model.expected()(fit_.used);
    return smooths_.rest(whitener_(fit_.state.rows().mean(mean) - fit_.measured));
  }
  MatrixXd slopes(const VectorXd& x, const VectorXd& here) const {
    MatrixXd result(here.size(), x.size());
    for (Index j = 0; j < x.size(); ++j) {
      const Unknown& u = unknown_[static_cast<std::size_t>(j)];
      double step = 1e-4 * (1 + std::abs(x[j]));
      if (x[j] + step > u.upper) step = -step;
      VectorXd moved = x;
      moved[j] += step;
      result.col(j) = (residual(moved) - here) / step;
    }
    return result;
  }
  // Shifts intervals with their values, clipped to the parameters' bounds unless cyclic.
  void store(const VectorXd& x) {
    for (std::size_t j = 0; j < unknown_.size(); ++j) {
      const double value = x[static_cast<Index>(j)];
      CauseValue* const v = unknown_[j].value;
      if (!v) {
        found_.parameters[unknown_[j].path] = value;
        continue;
      }
      for (double* end : {&v->lower95, &v->upper95}) {
        const double moved = unknown_[j].log ? *end * value / v->value : *end + value - v->value;
        *end = v->cyclic ? moved : std::clamp(moved, v->minimum, v->maximum);
      }
      v->value = value;
    }
  }

  const JointRefit& fit_;
  Diagnosis& found_;
  noise::Whitener whitener_;
  noise::Basis smooths_;
  std::vector<Unknown> unknown_;
  std::vector<std::string> inserted_;
};

}  // namespace

VectorXd refit_jointly(const JointRefit& fit, const VectorXd& lower, const VectorXd& upper,
                       const std::vector<std::string>& paths, Diagnosis& found) {
  Joint joint(fit, found);
  joint.add_parameters(paths, lower, upper);
  joint.add_causes();
  joint.solve();
  return joint.mean();
}

}  // namespace muster::diagnosis
