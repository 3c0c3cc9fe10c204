#include "diagnosis/pipeline/diagnose.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <tuple>
#include <utility>

#include "diagnosis/inference/state/null_tail.hpp"
#include "diagnosis/pipeline/diagnoser.hpp"
#include "diagnosis/pipeline/extended_world.hpp"
#include "diagnosis/pipeline/first_cause.hpp"
#include "diagnosis/pipeline/notes_of_given.hpp"
#include "diagnosis/radio/causes/applicability.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "text/temporary_folder.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::VectorXd;

bool names(const Diagnosis& found, const CauseEstimate& cause) {
  return std::any_of(found.causes.begin(), found.causes.end(), [&](const CauseEstimate& c) {
    return c.status == inference::Status::named && c.id == cause.id && c.label == cause.label;
  });
}

// True if errors at left-out places are larger beyond chance than beside all that was found in the given world, or by
// far. Four radios that are moved one by one may come nearer to a field than the plan that is shifted.
bool is_worse(const Diagnosis& out, const Diagnosis& found) {
  if (!found.unseen || !out.unseen) return false;
  const VectorXd &now = out.unseen->after, &before = found.unseen->after;
  const double ratio = now.mean() / before.mean();
  if (ratio <= thresholds::own_world_worse) return false;
  if (ratio > thresholds::own_world_far_worse || now.size() != before.size()) return true;
  inference::Unseen both = *out.unseen;
  both.before = before;
  return inference::compared(both).upper95 < 0;
}

// The same cause named once more, in the world put right for it.
std::vector<CauseEstimate>::iterator rest_of(const CauseEstimate& cause, Diagnosis& out) {
  return std::find_if(out.causes.begin() + 1, out.causes.end(), [&](const CauseEstimate& c) {
    return c.status == inference::Status::named && c.id == cause.id && c.label == cause.label;
  });
}

// Both are one. What the readings leave open of the rest they tell of the whole, but for what both leave open.
void add_rest(const CauseEstimate& rest, CauseEstimate& cause) {
  cause.values = rest.values;
  std::erase_if(cause.alternatives, [&](const inference::Alternative& a) {
    return std::none_of(rest.alternatives.begin(), rest.alternatives.end(),
                        [&](const inference::Alternative& b) { return a.id == b.id && a.label == b.label; });
  });
  cause.inflation = std::max(cause.inflation, rest.inflation);
  cause.evidence += rest.evidence;
  cause.log_p = inference::log_p_of_both(cause.log_p, rest.log_p);
  cause.lambda += rest.lambda;
  if (cause.effect.size() == rest.effect.size()) cause.effect += rest.effect;
}

struct Diagnosed {
  std::filesystem::path world, data;
  Library::SearchPath plugins;
  std::shared_ptr<TableCache> tables;
  const inference::Watch& watch;
  std::optional<double> end;  // of the table's readings, dBm

  // In the world corrected for a cause that was judged in a world of its own, in order. Nothing if the error at
  // left-out places is above that beside all that was found in the given world. `by_itself`: as of Diagnoser::run.
  std::optional<Diagnosis> corrected_for(const OwnWorldVerdict& verdict, const Diagnosis& found, bool by_itself) const {
    Diagnosis first = found;
    first.causes = {*verdict.cause};
    for (const auto& [path, value] : verdict.parameters) first.parameters[path] = value;
    const TemporaryFolder folder;
    Diagnosis out =
        Diagnoser(write_extended_world(first, world, folder.path()), data, plugins, tables, watch, {{}, end})
            .run(&first, by_itself);
    if (is_worse(out, found)) return {};
    keep_notes_of_given(world, found, folder.path(), out);
    in_order(out);
    return out;
  }

  // In the world put right for the first cause of `first`, which stays the first. Where the same is found there again,
  // such as a radio that is not where it was put, in the world put right for all at once, if that comes nearer.
  Diagnosis put_right(Diagnosis first, const Diagnosis& found) const {
    constexpr int most = 3;
    std::optional<Diagnosis> before;
    for (int times = 1;; ++times) {
      CauseEstimate& cause = first.causes[0];
      const TemporaryFolder folder;
      Diagnosis out =
          Diagnoser(write_extended_world(first, world, folder.path()), data, plugins, tables, watch, {found.mean, end})
              .run(&first);
      keep_notes_of_given(world, found, folder.path(), out);
      if (watch.stop() || cause.values.empty()) return out;
      if (before && is_worse(out, *before)) {
        const auto rest_before = rest_of(cause, *before);
        rest_before->status = inference::Status::suspected;
        rest_before->doubt = "the world put right for it, too, predicts what was left out worse";
        in_order(*before);
        return std::move(*before);
      }
      const auto rest = rest_of(cause, out);
      if (rest == out.causes.end()) return out;
      if (times == most) {
        add_rest(*rest, out.causes[0]);
        out.causes.erase(rest);
        return out;
      }
      add_rest(*rest, cause);
      before = std::move(out);
    }
  }
};

void add_searched(const OwnWorldVerdict& verdict, Diagnosis& out) {
  out.searched.insert(out.searched.end(), verdict.searched.begin(), verdict.searched.end());
  std::sort(out.searched.begin(), out.searched.end());
  out.not_tested.insert(out.not_tested.end(), verdict.not_tested.begin(), verdict.not_tested.end());
}

// Adds blockage to what was found without the readings that it blocked. It was judged before: where it is small and
// outweighed by another cause, it may be what that one had left over.
void add_blockage(CauseEstimate blockage, Diagnosis& found) {
  blockage.effect = VectorXd::Zero(found.rows);
  const bool is_outweighed = std::any_of(found.causes.begin(), found.causes.end(), [&](const CauseEstimate& c) {
    return c.status == inference::Status::named && c.evidence > blockage.evidence;
  });
  if (is_outweighed && blockage.lambda < thresholds::sure_blockage) {
    blockage.status = inference::Status::suspected;
    blockage.doubt = "small, and seen before the other causes were known: it may be what they had left over";
  }
  // Nothing was left out to see what it gains: its place is behind all that explain more.
  const auto rank = [](const CauseEstimate& c) { return std::tuple(c.status, !c.doubt.empty(), -c.lambda); };
  const auto stronger = std::find_if(found.causes.rbegin(), found.causes.rend(),
                                     [&](const CauseEstimate& c) { return rank(c) < rank(blockage); });
  found.causes.insert(stronger.base(), std::move(blockage));
}

// Of the world as it is given.
struct AsGiven {
  std::unique_ptr<Diagnoser> by;
  Diagnosis found;
  std::optional<double> end;  // of the table's readings, dBm
};

// Where the readings end at a floor, they are diagnosed again with that known. A floor that is not seen then is in
// doubt, unless it is the world's own by default.
AsGiven diagnosed_as_given(const std::filesystem::path& world, const std::filesystem::path& data,
                           const Library::SearchPath& plugins, const std::shared_ptr<TableCache>& tables,
                           const inference::Watch& watch) {
  AsGiven given{std::make_unique<Diagnoser>(world, data, plugins, tables, watch), {}, {}};
  given.found = given.by->run();
  if (!given.found.end || watch.stop()) return given;
  watch.at("diagnosing again, with readings that end at a floor");
  AsGiven ended{std::make_unique<Diagnoser>(world, data, plugins, tables, watch, Earlier{{}, given.found.end}), {}, {}};
  ended.found = ended.by->run();
  if (watch.stop()) return given;
  ended.end = given.found.end_of_default ? given.found.end : ended.found.end;
  if (ended.end) return ended;
  for (CauseEstimate& c : given.found.causes)
    if (!c.values.empty() && c.values[0].value == *given.found.end)
      c.doubt = "not seen again once the levels above it were set right";
  return given;
}

}  // namespace

// A fault of the map or the log that is likelier in a world of its own is corrected first. A radio in the wrong place
// biases all other findings: the diagnosis is repeated with the radio corrected. After blockage it is repeated without
// the blocked link, or the blocked readings. If a change in time remains, blockage must pass a stricter threshold. A
// radio that seems to stand where another should be may have its name: that is tried, too.
Diagnosis diagnose(const std::filesystem::path& world, const std::filesystem::path& data,
                   const Library::SearchPath& plugins, const std::shared_ptr<TableCache>& tables,
                   const inference::Watch& watch) {
  watch.at("fitting the world");
  auto [given, found, end] = diagnosed_as_given(world, data, plugins, tables, watch);
  if (found.interrupted) return found;
  if (watch.stop()) return interrupted(std::move(found));
  const OwnWorldVerdict verdict = given->in_own_worlds(found);
  const std::vector<Cause> causes = causes_on(plugins);
  const auto [spoiler, blockage] = first_in_company(found, causes);
  OwnWorldVerdict exchanged{{}, found.parameters, {}, {}};
  if (spoiler && !blockage) exchanged.cause = given->exchange(*spoiler, found);
  given.reset();
  if (verdict.cause && !names(found, *verdict.cause)) {
    watch.at("diagnosing again, with the world corrected for " + verdict.cause->id);
    auto corrected = Diagnosed{world, data, plugins, tables, watch, end}.corrected_for(verdict, found, true);
    if (watch.stop()) return interrupted(std::move(found));
    if (corrected) {
      add_searched(verdict, *corrected);
      return *corrected;
    }
  }
  add_searched(verdict, found);
  if (!spoiler) return found;
  watch.at("diagnosing again, with the world corrected for " + spoiler->id);
  Diagnosis first = found;
  first.causes = {*spoiler};
  first.causes[0].sought_as.clear();
  // What comes near in the corrected world decides that.
  if (first.causes[0].doubt == doubt_by_imitator(*spoiler, found.checks, causes)) first.causes[0].doubt.clear();
  if (!blockage) {
    Diagnosis corrected = Diagnosed{world, data, plugins, tables, watch, end}.put_right(first, found);
    if (watch.stop()) return interrupted(std::move(found));
    in_order(corrected);
    add_searched(verdict, corrected);
    if (!exchanged.cause) return corrected;
    watch.at("diagnosing again, with the world corrected for " + exchanged.cause->id);
    auto other = Diagnosed{world, data, plugins, tables, watch, end}.corrected_for(exchanged, found, false);
    if (watch.stop()) return interrupted(std::move(found));
    if (other) add_searched(verdict, *other);
    const bool both = other && other->unseen && corrected.unseen;
    return both && other->unseen->after.mean() < corrected.unseen->after.mean() ? *other : corrected;
  }
  const TemporaryFolder folder;
  Diagnosis again =
      Diagnoser(write_extended_world(first, world, folder.path()), data, plugins, tables, watch, {found.mean, end})
          .run();
  keep_notes_of_given(world, found, folder.path(), again);
  if (watch.stop()) return interrupted(std::move(found));
  if (first.causes[0].log_p > thresholds::blockage_in_company && something_changes_in_time(again)) {
    Diagnosis result = Diagnoser(world, data, plugins, tables, watch, {{}, end}, first.causes[0].id).run();
    if (watch.stop()) return interrupted(std::move(found));
    result.searched = found.searched;
    return result;
  }
  again.added_radios = found.added_radios;
  add_searched(verdict, again);
  if (first.causes[0].doubt.empty()) first.causes[0].doubt = doubt_by_imitator(first.causes[0], again.checks, causes);
  add_blockage(first.causes[0], again);
  return again;
}

}  // namespace muster::diagnosis
