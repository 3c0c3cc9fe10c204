#include "diagnosis/report/regression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/pipeline/extended_world.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/report/replay.hpp"
#include "text/names.hpp"

namespace muster::report {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* format_name = "muster_regression/1";
// Share of the gain in squared error that may be lost.
constexpr double loss_allowed = 0.1;

double rmse_of(const fs::path& world, const fs::path& data, const Library::SearchPath& plugins) {
  diagnosis::LinkModel model(world, data, plugins);
  const diagnosis::Dataset readings = diagnosis::read_dataset(data);
  const Eigen::VectorXd& mean = model.expected();
  double sum = 0, count = 0;
  for (std::size_t row = 0; row < readings.rows(); ++row) {
    const double error = readings.rssi[row] - mean[static_cast<Eigen::Index>(row)];
    if (std::isnan(error)) continue;
    sum += error * error;
    count += 1;
  }
  return std::sqrt(sum / std::max(count, 1.0));
}

// Limit between the error of the extended world and that of the world as given.
Json limit(double extended, double given) {
  const double lost = std::max(0.0, given * given - extended * extended);
  return {{"value", extended}, {"at_most", std::sqrt(extended * extended + loss_allowed * lost) + 1e-6}};
}

bool same_contents(const fs::path& one, const fs::path& other) {
  std::ifstream a(one, std::ios::binary), b(other, std::ios::binary);
  using Bytes = std::istreambuf_iterator<char>;
  return a && b && std::equal(Bytes(a), Bytes(), Bytes(b), Bytes());
}

// A file of that name with other contents stays: another table may be checked by it.
std::string copied(const fs::path& data, const fs::path& folder) {
  std::error_code none;
  fs::path to = folder / data.filename();
  if (fs::equivalent(data, to, none)) return to.filename().string();
  for (std::string name = data.filename().string(); fs::exists(to, none) && !same_contents(data, to);)
    to = folder / (name = "data_" + name);
  fs::copy_file(data, to, fs::copy_options::overwrite_existing, none);
  if (none) throw Error(Exit::io, to.string() + ": cannot be written: " + none.message());
  return to.filename().string();
}

// Intervals of the world's parameters in a diagnosis of it.
Json intervals_of(const std::vector<diagnosis::WorldValue>& values) {
  Json out = Json::array();
  for (const auto& v : values) {
    if (!v.identifiable) continue;
    const double half = 1.96 * v.stderror;
    out.push_back({{"path", v.path},
                   {"value", v.value},
                   {"lower95", v.value - half},
                   {"upper95", v.value + half},
                   {"unit", v.unit}});
  }
  return out;
}

Json parameters_of(const Diagnosis& d) {
  Json out = Json::array();
  std::map<std::string, int> count;
  for (const CauseEstimate& c : d.causes) {
    if (c.status != inference::Status::named) continue;
    const int number = ++count[c.id];
    for (const CauseValue& v : c.values) {
      if (!(v.upper95 > v.lower95)) continue;
      out.push_back({{"cause", c.id},
                     {"number", number},
                     {"parameter", v.name},
                     {"value", v.value},
                     {"lower95", v.lower95},
                     {"upper95", v.upper95},
                     {"unit", v.unit}});
    }
  }
  for (Json& value : intervals_of(d.world_values)) out.push_back(std::move(value));
  return out;
}

Json read_json(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in)
    throw Error(Exit::io,
                file.string() +
                    ": cannot be read; expected a folder that muster diagnose WORLD --data FILE --out FOLDER wrote");
  Json json = Json::parse(text.str(), nullptr, false);
  if (!json.is_object() || json.value("format", "") != format_name)
    throw Error(Exit::invalid_input,
                file.string() +
                    ": is not what a diagnosis wrote; expected the folder that muster diagnose WORLD --data "
                    "FILE --out FOLDER wrote");
  return json;
}

// Name of the k-th instance of a plugin in the world, "" if there is none.
std::string instance_of(const Simulation& run, const std::string& plugin, int number) {
  for (const auto& instance : run.instances()) {
    if (instance->declared().plugin == plugin && --number == 0) return instance->name();
  }
  return "";
}

Checked at_most(const std::string& what, double found, double most) {
  return {what, fmt::format("{:.3f} dB", found), fmt::format("at most {:.3f} dB", most), found <= most};
}

struct Limits {
  double low = 0, high = 0;
  std::string unit;
  bool cyclic = false;  // equal modulo a turn
};

Checked inside(const std::string& what, double found, const Limits& limits) {
  const double middle = (limits.low + limits.high) / 2;
  if (limits.cyclic) found = middle + std::remainder(found - middle, 2 * M_PI);
  const std::string unit = limits.unit.empty() ? "" : " " + limits.unit;
  return {what, fmt::format("{:.4g}{}", found, unit), fmt::format("{:.4g} to {:.4g}{}", limits.low, limits.high, unit),
          found >= limits.low && found <= limits.high};
}

Limits limits_of(const Json& p) { return {p.at("lower95"), p.at("upper95"), p.value("unit", ""), false}; }

void check_parameter(const Json& p, const diagnosis::LinkModel& model, std::vector<Checked>& out) {
  std::string path = p.value("path", "");
  if (path.empty()) {
    const std::string cause = p.at("cause"), name = p.at("parameter");
    const std::string instance = instance_of(model.simulation(), cause, p.value("number", 1));
    if (instance.empty()) {
      out.push_back({cause, "not in the world", "an instance of it", false});
      return;
    }
    path = instance + '/' + name;
  }
  const ParameterInfo written = model.parameter(path);
  Limits limits = limits_of(p);
  limits.cyclic = (written.declared->flags & MUSTER_CYCLIC) != 0;
  out.push_back(inside(path + ", as written", written.value, limits));
}

void check_fitted_again(const Json& p, const Diagnosis& again, std::vector<Checked>& out) {
  const std::string path = p.at("path");
  for (const auto& v : again.world_values) {
    if (v.path == path) out.push_back(inside(path + ", fitted again", v.value, limits_of(p)));
  }
}

// Limits of the extended world, as the closed loop met it. What its second diagnosis fits has intervals of its own: it
// may leave out a link, or see beside a parameter what the first did not.
Json of_extended(const Diagnosis& d, const fs::path& world, const fs::path& data, const fs::path& folder) {
  const diagnosis::Loop& loop = *d.loop;
  Json json = {{"format", format_name},
               {"world", (fs::is_directory(world) ? fs::path("world.xml") : world.filename()).string()},
               {"data", Json::array({{{"file", copied(data, folder)},
                                      {"rmse_db", limit(loop.rmse_extended, d.residual_sd)},
                                      {"rediagnosis", diagnosis::names_in_words(loop.rediagnosis)}}})},
               {"parameters", parameters_of(d)},
               {"fitted_again", intervals_of(loop.fitted_again)}};
  if (const auto& s = loop.second)
    json["data"].push_back({{"file", copied(s->data, folder)},
                            {"rmse_db", limit(s->rmse_extended, s->rmse_given)},
                            {"rediagnosis", diagnosis::names_in_words(s->rediagnosis)}});
  if (d.held_out && loop.unseen_error) json["heldout_rmse_db"] = limit(*loop.unseen_error, d.held_out->rmse_before);
  return json;
}

// Where nothing is named, the world as given: it must remain as adequate as it was. Its parameters are fitted anew in
// each diagnosis, so that nothing is held against their values as written.
Json of_given(const Diagnosis& d, const fs::path& world, const fs::path& data, const fs::path& folder) {
  Json json = {{"format", format_name},
               {"world", diagnosis::copy_world(world, folder).filename().string()},
               {"data", Json::array({{{"file", copied(data, folder)},
                                      {"rediagnosis", diagnosis::names_in_words(diagnosis::named_causes(d))}}})},
               {"parameters", Json::array()},
               {"fitted_again", intervals_of(d.world_values)}};
  if (d.held_out) json["heldout_rmse_db"] = limit(d.held_out->rmse_before, d.held_out->rmse_before);
  return json;
}

}  // namespace

std::vector<std::string> write_regression(const Diagnosis& d, const fs::path& world, const fs::path& data,
                                          const fs::path& folder) {
  if (d.interrupted || (!d.loop && d.named())) return {};
  const Json json = d.loop ? of_extended(d, world, data, folder) : of_given(d, world, data, folder);
  const fs::path file = folder / "regression.json";
  std::ofstream out(file, std::ios::binary);
  out << json.dump(2) << '\n';
  if (!out.flush()) throw Error(Exit::io, file.string() + ": cannot be written");
  if (!d.loop) return {file.string()};
  const std::string measured = json["data"][0]["file"];
  return {file.string(), write_replay(folder / json["world"], measured, folder / "replay.xml").string()};
}

std::vector<Checked> check_regression(const fs::path& from, const Library::SearchPath& plugins) {
  const fs::path file = fs::is_directory(from) ? from / "regression.json" : from;
  const fs::path folder = file.parent_path();
  if (fs::is_directory(from) && !fs::exists(file))
    throw Error(
        Exit::invalid_input,
        "--check: " + from.string() +
            (fs::exists(from / "world.xml") ? " is the folder of a world, and of no diagnosis" : " is no diagnosis") +
            "; expected the FOLDER that muster diagnose WORLD --data FILE --out FOLDER wrote");
  const Json json = read_json(file);
  std::vector<Checked> out;
  try {
    const fs::path world = folder / json.at("world").get<std::string>();
    bool first = true;
    for (const Json& one : json.at("data")) {
      const fs::path data = folder / one.at("file").get<std::string>();
      const std::string on = " on " + data.filename().string();
      if (one.contains("rmse_db"))
        out.push_back(
            at_most("error of a reading" + on, rmse_of(world, data, plugins), one.at("rmse_db").at("at_most")));
      const Diagnosis again = diagnosis::diagnose(world, data, plugins);
      if (first && json.contains("heldout_rmse_db") && again.held_out)
        out.push_back(at_most("error at places not seen" + on, again.held_out->rmse_before,
                              json.at("heldout_rmse_db").at("at_most")));
      if (first) {
        const diagnosis::LinkModel model(world, data, plugins);
        for (const Json& p : json.at("parameters")) check_parameter(p, model, out);
        for (const Json& p : json.value("fitted_again", Json::array())) check_fitted_again(p, again, out);
      }
      const std::string expected = one.at("rediagnosis"),
                        found = diagnosis::names_in_words(diagnosis::named_causes(again));
      out.push_back({"diagnosed again" + on, found, expected, found == expected || found == "silent"});
      first = false;
    }
  } catch (const Json::exception& e) {
    throw Error(Exit::invalid_input, file.string() + ": " + e.what());
  }
  return out;
}

}  // namespace muster::report
