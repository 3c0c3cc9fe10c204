#include "diagnosis/radio/causes/applicability.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace muster::diagnosis {

bool needs(const Cause& cause, const std::string& column) {
  std::istringstream words(cause.meaning().covariates);
  for (std::string word; words >> word;) {
    if (word == column) return true;
  }
  return false;
}

std::string own_column(const Cause& cause) {
  static const std::set<std::string> geometry = {"t",    "tx_x", "tx_y", "tx_z",  "tx_yaw",
                                                 "rx_x", "rx_y", "rx_z", "rx_yaw"};
  std::istringstream words(cause.meaning().covariates);
  for (std::string word; words >> word;) {
    if (!geometry.count(word)) return word;
  }
  return "";
}

std::string why_not(const Cause& cause, const MeasurementGeometry& survey, const Dataset& data) {
  if (needs(cause, "t") && !(survey.has_time && survey.time.length() > 0)) return "not testable: the data have no t";
  if (needs(cause, "rx_yaw") && !survey.has_yaw) return "not testable: the data have no rx_yaw or tx_yaw";
  if (needs(cause, "tx_x") && !survey.has_places) return "not testable: the data have distances, and no places";
  const std::string column = own_column(cause);
  if (column.empty()) return "";
  // A column for each material.
  if (column == "walls") return survey.counted.empty() ? "not testable: the data have no columns walls_MATERIAL" : "";
  for (const Covariate& c : data.covariates) {
    if (c.name.substr(0, c.name.find('[')) != column || c.values.empty()) continue;
    const bool whole = std::none_of(c.values.begin(), c.values.end(), [](double v) { return std::isnan(v); });
    return whole ? "" : "not testable: the column " + column + " has empty cells";
  }
  return "not testable: the data have no column " + column + " that varies";
}

namespace {

// True if a cause may concern a radio: one that sends and receives if it tells these apart, a turning one if it needs a
// heading, a stationary one if it needs only places.
bool may_be_about(const Cause& cause, const MeasurementGeometry& survey, std::size_t radio) {
  if (radio >= survey.turns.size()) return false;  // it took part in no reading
  if (cause.needs_both_ends() && !survey.both_ends[radio]) return false;
  return needs(cause, "rx_yaw") ? survey.turns[radio] : !(needs(cause, "tx_x") && survey.moves[radio]);
}

// Rows of a set: those of the world, and radios that the data alone name.
std::vector<std::string> names_in(const std::string& set, const LinkModel& model) {
  if (set == "radio") return model.radio_names();
  std::vector<std::string> result;
  for (const RowDeclaration& declared : model.simulation().world().rows) {
    if (std::find(declared.sets.begin(), declared.sets.end(), set) != declared.sets.end())
      result.push_back(declared.name);
  }
  return result;
}

std::vector<std::string> names_for(const Cause& cause, const muster_param& row, const LinkModel& model,
                                   const MeasurementGeometry& survey) {
  std::vector<std::string> result;
  // Without a radio it is about every receiver. What depends on a heading that all receivers have always is a direction
  // in the plan.
  if (!(row.flags & MUSTER_REQUIRED) && (survey.receivers_turn || !needs(cause, "rx_yaw"))) result.push_back("");
  for (const std::string& name : names_in(row.text, model)) {
    if (needs(cause, "walls") && !survey.counted.count(name)) continue;
    const auto number = static_cast<std::size_t>(model.simulation().board().find_set(row.text)->find(name));
    if (std::string_view(row.text) != "radio" || may_be_about(cause, survey, number)) result.push_back(name);
  }
  return result;
}

}  // namespace

std::string why_no_rows(const Cause& cause) {
  const auto references = cause.rows();
  std::string none = "not testable: the world has no row that it could be about";
  if (std::string_view(references[0]->text) != "radio") return none;
  none += references.size() == 2 ? " (two are needed" : " (one is needed";
  none += cause.needs_both_ends()  ? ", of the radios that send and receive)"
          : needs(cause, "rx_yaw") ? ", of the radios that turn)"
          : needs(cause, "tx_x")   ? ", of the radios that stand)"
                                   : ", of the radios with readings)";
  return none;
}

std::vector<CauseRow> rows_for(const Cause& cause, const LinkModel& model, const MeasurementGeometry& survey) {
  const auto references = cause.rows();
  if (references.empty()) return {{}};
  std::vector<CauseRow> result;
  const auto names = names_for(cause, *references[0], model, survey);
  for (std::size_t a = 0; a < names.size(); ++a) {
    if (references.size() == 1) result.push_back({names[a]});
    for (std::size_t b = a + 1; references.size() == 2 && b < names.size(); ++b) result.push_back({names[a], names[b]});
  }
  return result;
}

}  // namespace muster::diagnosis
