// muster probe WORLD A B: what becomes of the power that A sends on its way to B.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "diagnosis/radio/links/floor_plan.hpp"
#include "diagnosis/radio/links/run_tables.hpp"
#include "run_options.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "world_file/kinds.hpp"

namespace muster::cli {
namespace {

struct ProbeWords {
  std::string world, from, to;
  std::vector<std::string> plugins;
  double at = 0;
  bool expected = false, json = false;
};

ProbeWords probe_words(const Arguments& arguments) {
  CommandLine line(
      "probe",
      "A link's budget at a moment of a run: each wall and floor on the way, each term of the channel, each stage of "
      "the "
      "receiver,\n"
      "and why nothing is received where nothing is.\n"
      "Example: muster probe worlds/connectivity base leader --at 30");
  ProbeWords words;
  std::string at = "0";
  line.option("world", words.world, "the world's folder or file").required();
  line.option("from", words.from, "the radio that sends").required();
  line.option("to", words.to, "the radio that receives").required();
  line.option("--at", at, "seconds after the start").shows_default();
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first");
  line.flag("--expected", words.expected, "as the channel is expected on average, without shadowing and fading");
  line.flag("--json", words.json, "print the budget as JSON");
  line.parse(arguments);
  words.at = real_of(at, "--at", "s");
  return words;
}

constexpr std::size_t none = static_cast<std::size_t>(-1);

// One row of the blackboard a radio: its endpoint and the link between both.
struct Rows {
  std::size_t from = none, to = none, link = none;
};

std::size_t endpoint_of(const Simulation& run, const std::string& radio) {
  const auto names = names_of(run, "radio");
  if (std::find(names.begin(), names.end(), radio) == names.end())
    throw Error(Exit::invalid_input, "no radio of " + run.world().file.string() + " is called " + quote(radio) +
                                         which_is(run.world(), radio, "radio") + "; " + suggest(radio, names));
  const auto endpoints = rows_of<Endpoint>(run, "endpoint/*/radio");
  for (std::size_t i = 0; i < endpoints.size(); ++i)
    if (names.at(static_cast<std::size_t>(endpoints[i].radio)) == radio) return i;
  throw Error(Exit::invalid_input, "radio " + quote(radio) + " is not there at that time");
}

Rows rows_between(const Simulation& run, const ProbeWords& words) {
  expect_channel(run);
  Rows rows{endpoint_of(run, words.from), endpoint_of(run, words.to), none};
  if (rows.from == rows.to)
    throw Error(Exit::invalid_input, "a radio does not hear itself; expected two radios, not " + quote(words.from));
  const auto ends = rows_of<Ends>(run, "link/*/ends");
  for (std::size_t i = 0; i < ends.size(); ++i)
    if (static_cast<std::size_t>(ends[i].tx) == rows.from && static_cast<std::size_t>(ends[i].rx) == rows.to)
      rows.link = i;
  return rows;
}

double distance(const Pose& a, const Pose& b) {
  return std::sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

// In the order in which the wave meets them.
Json walls_between(const Simulation& run, const Pose& a, const Pose& b) {
  std::vector<scene::Crossing> crossings;
  try {
    scene_of(run).crossings({a.x, a.y, a.z}, {b.x, b.y, b.z}, crossings);
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& e) {  // the scene's words name the row at fault
    throw Error(Exit::invalid_input, run.world().file.string() + ": " + e.what());
  }
  std::sort(crossings.begin(), crossings.end(), [](const auto& p, const auto& q) { return p.fraction < q.fraction; });
  const auto walls = names_of(run, "wall"), doors = names_of(run, "door"), materials = names_of(run, "material");
  const auto floors = names_of(run, "floor");
  const auto losses = rows_of<Loss>(run, "material/*/loss");
  Json result = Json::array();
  for (const auto& c : crossings) {
    const auto material = static_cast<std::size_t>(c.material);
    Json wall = c.floor >= 0 ? Json{{"floor", floors.at(static_cast<std::size_t>(c.floor))}}
                             : Json{{"wall", walls.at(static_cast<std::size_t>(c.wall))}};
    if (c.door >= 0) wall["door"] = doors.at(static_cast<std::size_t>(c.door));
    wall["material"] = materials.at(material);
    wall["loss_db"] = losses.at(material).loss;
    wall["at_m"] = c.fraction * distance(a, b);
    wall["incidence_rad"] = std::acos(std::min(1.0, c.cos_incidence));
    result.push_back(wall);
  }
  return result;
}

// What each instance says of the link, in the order of steps: terms, what they sum up to, stages of the receiver.
Json lines_of(const Simulation& run, std::size_t link) {
  Json result = Json::array();
  bool summed = false;
  const auto say = [&](const std::string& instance, const std::string& what, const Table& table) {
    for (std::size_t c = 0; c < table.width(); ++c)
      result.push_back({{"instance", instance},
                        {"quantity", what},
                        {"column", table.columns()[c].title()},
                        {"value", table.now().data[link * table.width() + c]}});
  };
  const auto sum = [&] {
    if (const Table* level = run.board().find("link/*/level"); level && !std::exchange(summed, true))
      say("", "level", *level);
  };
  std::vector<const Instance*> in_order;
  for (const Batch& batch : run.batches())
    for (const Instance* instance : batch.instances) in_order.push_back(instance);
  for (const bool terms : {true, false}) {  // terms first: whatever stands between them, the sum is of them all
    for (const Instance* instance : in_order) {
      if (instance->phase() != MUSTER_RADIO) continue;
      for (const Claim& claim : instance->claims()) {
        if (!claim.out || claim.name.set != "link" || claim.name.quantity == "ends") continue;
        const bool is_term = claim.kind == MUSTER_ADD && claim.name.quantity == "level";
        if (is_term != terms) continue;
        if (!is_term) sum();
        say(instance->name(), claim.name.quantity + (claim.name.part.empty() ? "" : '@' + claim.name.part), *claim.out);
      }
    }
  }
  sum();
  return result;
}

std::string why_no_link(const Simulation& run) {
  for (const auto& instance : run.instances()) {
    const auto& claims = instance->claims();
    const int range = instance->find_param("range");
    if (range >= 0 && std::any_of(claims.begin(), claims.end(),
                                  [](const Claim& c) { return c.name.text() == "link/*/ends" && c.out; }))
      return fmt::format("no link: {} lists none beyond {} m", instance->name(),
                         print_real(instance->params()[static_cast<std::size_t>(range)]));
  }
  return "no link: none is listed from the one to the other";
}

std::string outcome_of(const Simulation& run, const Json& budget) {
  if (budget["link"].is_null()) return why_no_link(run);
  std::string last;
  for (const Json& line : budget["lines"].elements()) {
    const std::string& quantity = line["quantity"].text();
    if (quantity.compare(0, 4, "rssi") != 0) continue;
    if (line["value"].is_null())
      return "nothing is received: " + line["instance"].text() + " lets nothing so weak through";
    last = fmt::format("received at {:.2f} dBm", line["value"].real());
  }
  return last.empty() ? "no receiver: nothing writes link/*/rssi" : last;
}

Json budget_of(const Simulation& run, const ProbeWords& words) {
  const Rows rows = rows_between(run, words);
  const auto places = rows_of<Pose>(run, "endpoint/*/pose");
  const Pose &a = places[rows.from], &b = places[rows.to];
  Json budget{{"world", run.world().name}, {"from", words.from},           {"to", words.to},
              {"time", run.time()},        {"distance_m", distance(a, b)}, {"walls", walls_between(run, a, b)},
              {"link", nullptr},           {"lines", Json::array()}};
  if (rows.link != none) {
    budget["link"] = rows.link;
    budget["lines"] = lines_of(run, rows.link);
  }
  budget["outcome"] = outcome_of(run, budget);
  return budget;
}

void print(const Json& b) {
  fmt::print("{} to {} at {} s: {:.2f} m\n", b["from"].text(), b["to"].text(), print_real(b["time"].real()),
             b["distance_m"].real());
  for (const Json& w : b["walls"].elements()) {
    const std::string door = w.contains("door") ? ", door " + w["door"].text() : "";
    const std::string kind = w.contains("floor") ? "floor" : "wall";
    fmt::print("  at {:6.2f} m  {} {}{} ({}, {:.2f} dB), {:.0f} degrees from its normal\n", w["at_m"].real(), kind,
               w[kind].text(), door, w["material"].text(), w["loss_db"].real(),
               w["incidence_rad"].real() * 180 / 3.141592653589793);
  }
  for (const Json& line : b["lines"].elements()) {
    const std::string value = line["value"].is_null() ? "nothing" : fmt::format("{:.2f}", line["value"].real());
    fmt::print("  {:<20} {:<22} {:>9}  {}\n", line["instance"].text(), line["quantity"].text(), value,
               line["column"].text());
  }
  fmt::print("{}\n", b["outcome"].text());
}

}  // namespace

int run_probe(const Arguments& arguments) {
  const ProbeWords words = probe_words(arguments);
  World world = read_world(words.world, standard());
  const uint64_t until = tick_in_run(world, words.at, "--at");
  Simulation run(std::move(world), standard(), {plugin_path(words.plugins), 1, {}});
  Progress progress("probe");
  watch_interrupt();
  while (run.tick() < until && !interrupted()) {
    run.step();
    progress.at(static_cast<double>(run.tick()) / static_cast<double>(until));
  }
  if (interrupted()) return static_cast<int>(Exit::interrupted);
  run.evaluate(MUSTER_RADIO, words.expected);
  const Json budget = budget_of(run, words);
  if (words.json)
    fmt::print("{}\n", budget.dump(2));
  else
    print(budget);
  return 0;
}

}  // namespace muster::cli
