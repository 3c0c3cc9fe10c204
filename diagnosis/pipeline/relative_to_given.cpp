#include "diagnosis/pipeline/relative_to_given.hpp"

#include <map>

#include "diagnosis/pipeline/first_cause.hpp"
#include "diagnosis/pipeline/row_summary.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Held-out errors of the given world (`before`) and of the corrected one (`after`), at their common readings.
inference::Unseen errors_beside(const Diagnosis& given, const VectorXd& before, const VectorXd& after,
                                const Diagnosis& out) {
  std::map<Index, Index> place;
  for (std::size_t k = 0; k < given.used.size(); ++k) place[given.used[k]] = static_cast<Index>(k);
  std::vector<Index> theirs, ours;
  inference::Unseen both;
  both.seed = out.unseen->seed;
  for (std::size_t k = 0; k < out.used.size(); ++k) {
    const auto at = place.find(out.used[k]);
    if (at == place.end()) continue;
    theirs.push_back(at->second);
    ours.push_back(static_cast<Index>(k));
    both.block.push_back(out.unseen->block[k]);
  }
  both.before = before(theirs);
  both.after = after(ours);
  return both;
}

}  // namespace

void begin_as_given(const Diagnosis& given, bool by_itself, const CorrectedSearch& corrected, Diagnosis& out) {
  const inference::ModelState& state = corrected.state;
  CauseEstimate& first = *out.causes.insert(out.causes.begin(), given.causes.front());
  first.corrected_first = true;
  if (first.doubt.empty()) first.doubt = doubt_by_imitator(first, out.checks, corrected.setup.causes);
  const VectorXd left = corrected.measured - state.rows().mean(given.fitted(corrected.setup.used.rows));
  const VectorXd left_by_stream = state.rows().by_stream(left);
  first.effect = left_by_stream - out.seen.before;
  const inference::WhitenedModel alone = state.whitened_model(state.base());
  out.seen.before = left_by_stream;
  out.seen.white_before = white_by_stream(state.rows(), alone.at.basis.rest(alone.whitener(left)));
  out.residual_sd = given.residual_sd;
  out.added_radios = given.added_radios;  // the corrected world lists those of its cause
  first.held_out.reset();
  out.held_out.reset();
  first.elsewhere.clear();
  out.elsewhere.clear();  // the place of a held-out radio cannot be corrected
  if (!given.unseen || !out.unseen) return out.stairs.clear();
  first.held_out = inference::compared(by_itself ? errors_beside(given, given.unseen->before, out.unseen->before, out)
                                                 : errors_beside(given, first.unseen_without, out.unseen->after, out));
  out.unseen = errors_beside(given, given.unseen->before, out.unseen->after, out);
  out.held_out = inference::compared(*out.unseen);
  if (!out.stairs.empty()) out.stairs.front().with = first.id;
  out.stairs.insert(out.stairs.begin(), inference::stair_of(*out.unseen));
}

}  // namespace muster::diagnosis
