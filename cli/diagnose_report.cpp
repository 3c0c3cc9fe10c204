#include "diagnose_report.hpp"

#include <fmt/core.h>

#include <cmath>

namespace muster::cli {
namespace {

using Json = nlohmann::ordered_json;
using namespace diagnosis;

constexpr double decided = 25;  // D from which the data tell two causes apart

// JSON has no NaN: what is not known is null.
Json known(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

const char* status_name(search::Status status) { return status == search::Status::named ? "named" : "suspected"; }

Json cause_json(const FoundCause& c) {
  Json parameters = Json::array(), rivals = Json::array();
  for (const CauseValue& v : c.values)
    parameters.push_back({{"name", c.id + '/' + v.name},
                          {"value", v.value},
                          {"stderr", known(v.stderror)},
                          {"lower95", known(v.lower95)},
                          {"upper95", known(v.upper95)},
                          {"unit", v.unit}});
  for (const search::Rival& r : c.rivals)
    rivals.push_back({{"id", r.id}, {"evidence_gap", known(r.evidence_gap)}, {"separability", known(r.separability)}});
  const auto gain = [&](double search::HeldOut::*which) { return c.held_out ? known(*c.held_out.*which) : Json(); };
  return {{"id", c.id},
          {"label", c.label},
          {"status", status_name(c.status)},
          {"parameters", parameters},
          {"evidence", c.evidence},
          {"heldout_rmse_before_db", gain(&search::HeldOut::rmse_before)},
          {"heldout_rmse_after_db", gain(&search::HeldOut::rmse_after)},
          {"gain_lower95", gain(&search::HeldOut::lower95)},
          {"gain_upper95", gain(&search::HeldOut::upper95)},
          {"rivals", rivals}};
}

// The cause's title with its slots filled.
std::string sentence(const FoundCause& c) {
  std::string text;
  for (std::size_t k = 0; k < c.title.size(); ++k) {
    const auto end = c.title[k] == '{' ? c.title.find('}', k) : std::string::npos;
    if (end == std::string::npos) {
      text += c.title[k];
      continue;
    }
    const std::string slot = c.title.substr(k + 1, end - k - 1);
    std::string word = c.row.empty() ? "all radios" : c.row;
    if (const auto other = c.words.find(slot); other != c.words.end()) word = other->second;
    for (const CauseValue& v : c.values) {
      if (v.name == slot) word = fmt::format("{:.4g}{}{}", v.value, v.unit.empty() ? "" : " ", v.unit);
    }
    text += word;
    k = end;
  }
  return text;
}

void print_cause(const FoundCause& c, int number) {
  fmt::print("\n({}) {}: {}{}\n", number, c.id, c.status == search::Status::named ? "" : "suspected: ", sentence(c));
  fmt::print("    {}, evidence {:.1f} nats\n", c.label, c.evidence);
  for (const CauseValue& v : c.values)
    fmt::print("    {:<12} {:>10.4g} {:<5} 95 %: {:.4g} to {:.4g}\n", v.name, v.value, v.unit, v.lower95, v.upper95);
  if (c.held_out)
    fmt::print(
        "    error on places not seen {:.3f} dB without it, {:.3f} dB with it; gain {:.2f} dB2, 95 %: {:.2f} to "
        "{:.2f} over {} blocks{}\n",
        c.held_out->rmse_before, c.held_out->rmse_after, c.held_out->gain, c.held_out->lower95, c.held_out->upper95,
        c.held_out->blocks, c.held_out->lower95 <= 0 ? ": new places do not confirm it yet" : "");
  for (const search::Rival& r : c.rivals)
    fmt::print("    rival {} {}: {:.1f} nats behind, separability D {:.0f}{}\n", r.id, r.label, r.evidence_gap,
               r.separability, r.separability < 12 ? " (cannot be told apart)" : "");
  if (!c.rivals.empty()) fmt::print("    to tell them apart: {}\n", c.tell_apart);
}

}  // namespace

Json diagnosis_json(const Diagnosis& d) {
  Json causes = Json::array(), unexplained = Json::array(), advice = Json::array();
  for (const FoundCause& c : d.causes) {
    causes.push_back(cause_json(c));
    for (const search::Rival& r : c.rivals) {
      if (r.separability < decided)
        advice.push_back({{"do", c.tell_apart}, {"separates", c.id + " " + r.id}, {"predicted_separability", nullptr}});
    }
  }
  for (const Unexplained& u : d.unexplained)
    unexplained.push_back({{"covariate", u.covariate}, {"evidence", u.evidence}});
  const auto error = [&](double search::HeldOut::*which) { return d.held_out ? known(*d.held_out.*which) : Json(); };
  Json out = {{"verdict", d.verdict()},
              {"noise",
               {{"family", std::string(noise::name_of(d.noise.family))},
                {"sigma_db", std::sqrt(d.noise.field_variance())},
                {"decorrelation_m", d.noise.decorrelation()},
                {"fading", std::sqrt(d.noise.reading_variance())}}},
              {"base", {{"residual_sd_db", d.residual_sd}, {"heldout_rmse_db", error(&search::HeldOut::rmse_before)}}},
              {"causes", causes},
              {"unexplained", unexplained},
              {"advice", advice},
              {"extended_world", d.loop ? Json(d.loop->world.string()) : Json()},
              {"heldout_rmse_db", error(&search::HeldOut::rmse_after)}};
  out["loop"] =
      d.loop ? Json{{"mean_difference_db", d.loop->mean_difference}, {"rediagnosis", d.loop->rediagnosis}} : Json();
  out["parameters"] = d.parameters;
  out["searched"] = d.searched;
  out["not_searched"] = d.not_tested;
  return out;
}

void print_diagnosis(const Diagnosis& d, const std::string& world) {
  fmt::print("{}: {}\n", world, d.verdict());
  fmt::print("{} readings in {} rows; the fitted world leaves {:.3f} dB", d.readings, d.rows, d.residual_sd);
  if (d.held_out) fmt::print(", {:.3f} dB at places it has not seen", d.held_out->rmse_before);
  fmt::print("\nnoise: {} field of {:.2f} dB over {:.2f} m, {:.2f} dB a reading\n", noise::name_of(d.noise.family),
             std::sqrt(d.noise.field_variance()), d.noise.decorrelation(), std::sqrt(d.noise.reading_variance()));
  int number = 0;
  for (const FoundCause& c : d.causes) print_cause(c, ++number);
  for (const Unexplained& u : d.unexplained)
    fmt::print("\nunexplained: something depends on {}, evidence {:.1f} nats; no cause fits\n", u.covariate,
               u.evidence);
  if (d.causes.empty() && d.unexplained.empty()) fmt::print("\nnothing was found\n");
  if (d.held_out && d.held_out->gain != 0)
    fmt::print("\nin all: {:.3f} -> {:.3f} dB at places not seen\n", d.held_out->rmse_before, d.held_out->rmse_after);
  if (d.loop)
    fmt::print("extended world: {}\n  simulated, its mean is within {:.2g} dB of the diagnosis; diagnosed again: {}\n",
               d.loop->world.string(), d.loop->mean_difference, d.loop->rediagnosis);
  fmt::print("\nsearched:");
  for (const std::string& id : d.searched) fmt::print(" {}", id);
  fmt::print("\n");
  for (const std::string& why : d.not_tested) fmt::print("not searched: {}\n", why);
  for (const std::string& note : d.notes) fmt::print("note: {}\n", note);
}

}  // namespace muster::cli
