#include "tests/diagnosis/inference/planted.hpp"

#include <fmt/format.h>

#include <boost/math/distributions/binomial.hpp>
#include <cmath>

#include "muster/random.hpp"

namespace muster::synthetic {
namespace {

// The effect at a random grid point of the cause; places and times are shifted off the grid by up to half a step.
Eigen::VectorXd effect_of(const World& world, const inference::Candidate& cause, double lambda) {
  const Stream stream(combined(key_of("planted"), world.recipe.seed));
  for (uint64_t k = 0;; ++k) {
    Eigen::VectorXd theta =
        cause.design
            .grid[static_cast<std::size_t>(stream.uniform(k, 0) * static_cast<double>(cause.design.grid.size()))];
    for (Index j = 0; j < cause.refinement.step.size(); ++j)
      theta[j] += cause.refinement.step[j] * (stream.uniform(k, 1 + static_cast<uint64_t>(j)) - 0.5);
    if (cause.refinement.admitted && cause.refinement.admitted(theta) < 1) continue;
    Eigen::MatrixXd columns = cause.design.columns(theta);
    const Eigen::VectorXd mixed = columns.rowwise().sum();
    if ((mixed.array() != 0).cast<double>().mean() < 0.01) continue;
    return scaled_to(world, cause.design.sign < 0 ? Eigen::VectorXd(-mixed) : mixed, lambda);
  }
}

std::string pieces_of(const std::vector<inference::Candidate>& causes, const std::string& id) {
  for (const auto& c : causes) {
    if (c.id == id) return c.role.pieces;
  }
  return {};
}

void count(const inference::Result& result, uint64_t seed, const std::string& cause, const std::string& pieces,
           const std::vector<inference::Candidate>& causes, Tally& tally) {
  std::string strongest, other, smooth;
  int alike = 0;  // named causes of the planted class of places
  for (const inference::Finding& f : result.findings) {
    if (f.status == inference::Status::suspected) continue;
    if (f.status == inference::Status::unexplained) smooth += ' ' + f.id;
    if (f.status != inference::Status::named) continue;
    if (strongest.empty()) strongest = f.id;
    const bool kin = !pieces.empty() && pieces_of(causes, f.id) == pieces;
    alike += f.id == cause || kin;
    if (f.id != cause && !kin) other += ' ' + f.id;
  }
  const bool found = strongest == cause && !cause.empty();
  const bool kin = !found && !pieces.empty() && pieces_of(causes, strongest) == pieces;
  tally.found += found;
  tally.kin += kin;
  tally.pieces += alike > 1;
  tally.wrong += !other.empty();
  tally.unexplained += !smooth.empty();
  if ((found || cause.empty()) && alike < 2 && other.empty() && smooth.empty()) return;
  tally.misses +=
      "\n  " + std::to_string(seed) + ": " + strongest + (alike > 1 ? " in pieces |" : " |") + other + smooth;
  for (const inference::Trial& trial : result.trials) {
    if (!trial.accepted)
      tally.misses +=
          fmt::format("; {} gain {:.0f} log p {:.1f}, {:.1f}", trial.id, trial.gain, trial.log_p, trial.marginal_log_p);
  }
}

}  // namespace

Tally planted(const std::string& cause, double lambda, uint64_t first, int worlds, Index readings, Shape shape,
              Field field) {
  Tally tally;
  tally.worlds = worlds;
  for (uint64_t seed = first; seed < first + static_cast<uint64_t>(worlds); ++seed) {
    Recipe recipe = varied(seed, readings);
    recipe.shape = shape;
    const World world = world_of(recipe);
    const auto causes = causes_of(world);
    Eigen::VectorXd effect = Eigen::VectorXd::Zero(readings);
    std::string pieces;
    for (const auto& c : causes) {
      if (c.id != cause) continue;
      effect = effect_of(world, c, lambda);
      pieces = c.role.pieces;
    }
    inference::Problem problem = problem_of(world, effect, causes);
    if (field == Field::stated) problem.stated = {recipe.sigma, recipe.decorrelation};
    count(inference::Search(problem).run(), seed, cause, pieces, causes, tally);
  }
  return tally;
}

int least_successes(int trials, double p) {
  return static_cast<int>(std::floor(boost::math::quantile(boost::math::binomial(trials, p), 0.001)));
}

}  // namespace muster::synthetic
