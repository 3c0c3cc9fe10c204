#include "diagnosis/report/json.hpp"

#include <cmath>

#include "diagnosis/report/advice.hpp"
#include "diagnosis/report/checked.hpp"
#include "diagnosis/report/words.hpp"

namespace muster::report {
namespace {

// JSON has no NaN: unknown values are null.
Json known(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json held_out_json(const std::optional<inference::HeldOutGain>& h) {
  const auto of = [&](double inference::HeldOutGain::*which) { return h ? known(*h.*which) : Json(nullptr); };
  return {{"heldout_rmse_before_db", of(&inference::HeldOutGain::rmse_before)},
          {"heldout_rmse_after_db", of(&inference::HeldOutGain::rmse_after)},
          {"gain_lower95", of(&inference::HeldOutGain::lower95)},
          {"gain_upper95", of(&inference::HeldOutGain::upper95)},
          {"gain_db2", of(&inference::HeldOutGain::gain)},
          {"blocks", h ? Json(h->blocks) : Json(nullptr)}};
}

Json elsewhere_json(const std::vector<inference::Elsewhere>& elsewhere) {
  Json out = Json::array();
  for (const inference::Elsewhere& e : elsewhere) {
    Json one = {{"left_out", e.left_out}};
    one.update(held_out_json(e.held_out));
    out.push_back(one);
  }
  return out;
}

Json rivals_json(const std::vector<inference::Alternative>& alternatives) {
  Json out = Json::array();
  for (const inference::Alternative& r : alternatives)
    out.push_back({{"id", r.id},
                   {"label", r.label},
                   {"evidence_gap", known(r.evidence_gap)},
                   {"separability", known(r.separability)},
                   {"in_headline", is_in_headline(r)}});
  return out;
}

Json one_station_json(const std::optional<diagnosis::OneStation>& seen) {
  if (!seen) return nullptr;
  return {{"radio", seen->radio},
          {"nearest_m", known(seen->nearest)},
          {"farthest_m", known(seen->farthest)},
          {"second_x_m", seen->second ? Json(seen->second->x()) : Json()},
          {"second_y_m", seen->second ? Json(seen->second->y()) : Json()}};
}

Json cause_json(const CauseEstimate& c) {
  Json parameters = Json::array();
  for (const CauseValue& v : c.values) {
    const bool sure = v.upper95 > v.lower95;
    parameters.push_back({{"name", c.id + '/' + v.name},
                          {"value", v.value},
                          {"stderr", sure ? known(v.stderror) : Json(nullptr)},
                          {"lower95", sure ? known(v.lower95) : Json(nullptr)},
                          {"upper95", sure ? known(v.upper95) : Json(nullptr)},
                          {"unit", v.unit}});
  }
  Json out = {{"id", c.id},
              {"label", c.label},
              {"status", c.status == inference::Status::named ? "named" : "suspected"},
              {"confirmed", confidence_of(c) == Confidence::confirmed},
              {"sentence", sentence(c)},
              {"parameters", parameters},
              {"evidence", known(c.evidence)},
              {"inflation", c.inflation},
              {"lambda", known(c.lambda)}};
  out.update(held_out_json(c.held_out));
  out["elsewhere"] = elsewhere_json(c.elsewhere);
  out["rivals"] = rivals_json(c.alternatives);
  out["tell_apart"] = c.tell_apart;
  out["one_station"] = one_station_json(c.one_station);
  out["doubt"] = c.doubt.empty() ? Json() : Json(c.doubt);
  return out;
}

Json unexplained_json(const diagnosis::Unexplained& u) {
  Json out = {{"covariate", u.covariate},
              {"evidence", known(u.evidence)},
              {"lambda", known(u.lambda)},
              {"reach_db", known(u.reach)}};
  out.update(held_out_json(u.held_out));
  out["elsewhere"] = elsewhere_json(u.elsewhere);
  out["rivals"] = rivals_json(u.alternatives);
  return out;
}

Json instrument_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const diagnosis::ReceiverCheck& c : d.receiver.checks)
    out.push_back({{"check", c.what}, {"found", c.found}, {"fine", c.fine}, {"row", c.row ? Json(*c.row) : Json()}});
  return out;
}

Json advice_json(const Diagnosis& d) {
  Json out = Json::array();
  const auto add = [&](const std::string& say, const Question& q, Json predicted, bool advised) {
    out.push_back({{"do", say},
                   {"separates", q.cause + ' ' + q.alternative},
                   {"predicted_separability", std::move(predicted)},
                   {"separability", known(q.separability)},
                   {"advised", advised}});
  };
  for (const Question& q : open_questions(d)) {
    for (const Measurement& m : q.plans) add(m.say, q, known(m.predicted), m.advised);
    add(q.tell_apart, q, nullptr, false);
  }
  return out;
}

Json checks_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const inference::Check& c : d.checks) {
    if (found(d, c.id)) continue;
    const bool smooth = c.kind == inference::Kind::smooth;
    out.push_back({{smooth ? "covariate" : "cause", smooth ? c.id.substr(1) : c.id},
                   {"p", std::exp(std::min(c.log_p, 0.0))},
                   {"lambda", known(c.gain)},
                   {"refused", c.refused.empty() ? Json() : Json(c.refused)}});
  }
  return out;
}

Json stairs_json(const Diagnosis& d) {
  Json out = Json::array();
  for (std::size_t k = 0; k < d.stairs.size(); ++k)
    out.push_back({{"with", name_of_step(d, k)},
                   {"heldout_rmse_db", known(d.stairs[k].rmse)},
                   {"lower95", known(d.stairs[k].lower95)},
                   {"upper95", known(d.stairs[k].upper95)}});
  return out;
}

Json loop_json(const Diagnosis& d) {
  if (!d.loop) return nullptr;
  Json out = {{"mean_difference_db", known(d.loop->mean_difference)},
              {"rediagnosis", diagnosis::names_in_words(d.loop->rediagnosis)}};
  out["second"] = nullptr;
  if (const auto& s = d.loop->second)
    out["second"] = {{"data", s->data.string()},
                     {"readings", s->readings},
                     {"rmse_given_db", known(s->rmse_given)},
                     {"rmse_extended_db", known(s->rmse_extended)},
                     {"rediagnosis", diagnosis::names_in_words(s->rediagnosis)}};
  return out;
}

Json world_json(const Diagnosis& d) {
  Json out = Json::array();
  for (const auto& v : d.world_values)
    out.push_back({{"name", v.path},
                   {"value", v.value},
                   {"stderr", v.identifiable ? known(v.stderror) : Json()},
                   {"unit", v.unit},
                   {"identifiable", v.identifiable},
                   {"at_bound", v.at_bound}});
  return out;
}

}  // namespace

Json json_of(const Diagnosis& d) {
  Json causes = Json::array(), unexplained = Json::array();
  for (const CauseEstimate& c : d.causes) causes.push_back(cause_json(c));
  for (const auto& u : d.unexplained) unexplained.push_back(unexplained_json(u));
  const auto error = [&](double inference::HeldOutGain::*which) {
    return d.held_out ? known(*d.held_out.*which) : Json();
  };
  return {
      {"verdict", d.verdict()},
      {"noise",
       {{"family", noise::name_of(d.noise.family)},
        {"sigma_db", known(std::sqrt(d.noise.field_variance()))},
        {"decorrelation_m", d.time_unit > 0 ? Json() : known(d.noise.decorrelation())},
        {"decorrelation_s", d.time_unit > 0 ? known(d.noise.decorrelation() * d.time_unit) : Json()},
        {"fading", known(std::sqrt(d.noise.reading_variance()))},
        {"floor_db", known(noise_floor(d))}}},
      {"base",
       {{"residual_sd_db", known(d.residual_sd)}, {"heldout_rmse_db", error(&inference::HeldOutGain::rmse_before)}}},
      {"causes", causes},
      {"unexplained", unexplained},
      {"advice", advice_json(d)},
      {"extended_world", d.loop ? Json(d.loop->world.string()) : Json()},
      {"heldout_rmse_db", error(&inference::HeldOutGain::rmse_after)},
      {"loop", loop_json(d)},
      {"summary", verdict_in_words(d)},
      {"interrupted", d.interrupted},
      {"readings", d.readings},
      {"rows", d.rows},
      {"blocks", d.held_out ? Json(d.held_out->blocks) : Json()},
      {"elsewhere", elsewhere_json(d.elsewhere)},
      {"steps", stairs_json(d)},
      {"parameters", d.parameters},
      {"world_parameters", world_json(d)},
      {"checked", checks_json(d)},
      {"instrument", instrument_json(d)},
      {"searched", d.searched},
      {"not_searched", d.not_tested},
      {"notes", d.notes}};
}

}  // namespace muster::report
