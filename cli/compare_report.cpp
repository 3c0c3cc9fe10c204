#include "compare_report.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "run_options.hpp"
#include "text/number.hpp"

namespace muster::cli {
namespace {

double time_of(const Simulation& run, uint64_t tick) { return static_cast<double>(tick) * run.world().dt; }
std::string time_text(const Simulation& run, uint64_t tick) {
  return tick == Course::never ? "-" : fmt::format("{:.6g} s", time_of(run, tick));
}

bool is_own_line(const Measure& measure) { return measure.column[0] < 0; }

// The tables that a reader is shown, in order. Endpoints are left out: radios are where their robots are.
std::vector<std::string> shown(const Simulation& run) {
  std::vector<std::string> result;
  for (const auto& set : standard().sets) {
    if (set.name == std::string("endpoint")) continue;
    for (const auto& quantity : set.quantities) result.push_back(std::string(set.name) + "/*/" + quantity.name);
  }
  for (const auto& instance : run.instances()) {
    for (const Claim& claim : instance->claims()) {
      if (instance->phase() == MUSTER_OBSERVE && claim.out) result.push_back(claim.out->name());
    }
  }
  return result;
}

void add(Quantity& to, const std::string& row, const Measure& measure, const Course& course, uint64_t end) {
  if (course.first == Course::never) return;
  if (to.worst_row.empty() || course.largest > to.largest) {
    to.largest = course.largest;
    to.largest_at = course.largest_at;
    to.worst_row = row;
    to.worst_column = measure.name;
  }
  if (const double now = std::abs(course.at(end)); now > to.end) to.end = now;
  to.first = std::min(to.first, course.first);
  to.beyond = std::min(to.beyond, course.beyond);
  to.unlike = std::max(to.unlike, course.unlike);
}

void add_quantities(const std::string& name, const TableDivergence& table, uint64_t end, std::vector<Quantity>& all) {
  const std::size_t before = all.size();
  for (std::size_t m = 0; m < table.measures.size(); ++m) {
    const Measure& measure = table.measures[m];
    const bool own_line = is_own_line(measure) || !std::isnan(table.tolerance[m]);
    auto line = std::find_if(all.begin() + static_cast<std::ptrdiff_t>(before), all.end(),
                             [&](const Quantity& q) { return !own_line && q.name.empty() && q.unit == measure.unit; });
    if (line == all.end()) {
      all.push_back({name, own_line ? measure.name : "", measure.unit, "", ""});
      all.back().tolerance = table.tolerance[m];
      line = all.end() - 1;
    }
    for (const auto& [row, courses] : table.rows) add(*line, row, measure, courses[m], end);
    const auto& trace = table.trace[m];
    line->trace.resize(std::max(line->trace.size(), trace.size()));
    for (std::size_t i = 0; i < trace.size(); ++i) line->trace[i] = std::max(line->trace[i], trace[i]);
  }
  all.erase(std::remove_if(all.begin() + static_cast<std::ptrdiff_t>(before), all.end(),
                           [](const Quantity& q) { return q.first == Course::never && std::isnan(q.tolerance); }),
            all.end());
}

}  // namespace

std::string Quantity::title() const {
  return table + (name.empty() ? "" : ' ' + name) + (unit.empty() ? "" : " [" + unit + ']');
}

std::vector<Quantity> quantities(const Simulation& run, const Divergence& divergence,
                                 std::vector<std::string>& others) {
  std::vector<Quantity> result;
  const auto names = shown(run);
  for (const std::string& name : names) {
    const auto found = divergence.tables().find(name);
    if (found != divergence.tables().end()) add_quantities(name, found->second, divergence.tick(), result);
  }
  for (const auto& [name, table] : divergence.tables()) {
    if (std::find(names.begin(), names.end(), name) != names.end()) continue;
    if (std::all_of(table.tolerance.begin(), table.tolerance.end(), [](double t) { return std::isnan(t); })) {
      if (!table.rows.empty()) others.push_back(name);
    } else {
      add_quantities(name, table, divergence.tick(), result);
    }
  }
  return result;
}

namespace {

void print_runs(const std::vector<ComparedRun>& runs) {
  std::size_t width = 0;
  for (const auto& r : runs) width = std::max(width, r.what.size());
  for (const auto& r : runs) {
    fmt::print("  {}  {:<{}}  {} ticks of {} s, seed {}, digest {}{}\n", r.label, r.what, width, r.run->tick(),
               print_real(r.run->world().dt), r.run->world().seed, hexadecimal(r.run->digest()),
               r.fault ? "; stopped" : "");
  }
  const bool common = std::all_of(
      runs.begin(), runs.end(), [&](const ComparedRun& r) { return r.run->world().seed == runs[0].run->world().seed; });
  if (common)
    fmt::print(
        "Common random numbers: all have seed {}, and a draw depends on it, its stream, names, and tick or place "
        "alone.\n",
        runs[0].run->world().seed);
  else
    fmt::print("The seeds differ, and with them the random numbers.\n");
}

// What happened in this run and not in the first.
void print_events(const std::vector<ComparedRun>& runs) {
  const auto text = [](const Simulation& run, const Event& e) {
    return fmt::format("t = {:.9g} s  {}{}{}", time_of(run, e.tick), e.instance, e.instance.empty() ? "" : ": ",
                       e.message);
  };
  std::vector<std::string> of_first;
  for (const auto& event : runs[0].run->events()) of_first.push_back(text(*runs[0].run, event));
  for (const auto& r : runs) {
    for (const auto& event : r.run->events()) {
      const std::string line = text(*r.run, event);
      if (&r == &runs[0] || std::find(of_first.begin(), of_first.end(), line) == of_first.end())
        fmt::print("  {}  {}\n", r.label, line);
    }
    if (r.fault) fmt::print("  {}  {}\n", r.label, r.fault->what());
  }
}

void print_first(const ComparedRun& a, const ComparedRun& b) {
  const FirstDifference& first = *b.divergence->first();
  fmt::print("  first     tick {} (t = {}): {}, row {}{}{}\n", first.tick, time_text(*a.run, first.tick), first.table,
             first.row, first.column.empty() ? "" : ", ", first.column);
  for (std::size_t i = 0; i < 2; ++i)
    fmt::print("            {} = {}, by {}\n", i == 0 ? a.label : b.label, first.value[i], first.writer[i]);
}

void print_rows(const Simulation& run, const std::string& name, const TableDivergence& table, uint64_t end) {
  constexpr std::size_t most = 6;
  std::vector<std::pair<std::string, const std::vector<Course>*>> rows;
  for (const auto& [row, courses] : table.rows) rows.emplace_back(row, &courses);
  if (rows.size() < 2) return;
  std::stable_sort(rows.begin(), rows.end(),
                   [](const auto& x, const auto& y) { return (*x.second)[0].largest > (*y.second)[0].largest; });
  fmt::print("\n  {:<20} {:>12} {:>10} {:>12}   {:>12} {:>10} {:>12}\n", name, "distance [m]", "at", "at the end",
             "heading [rad]", "at", "at the end");
  for (std::size_t i = 0; i < std::min(most, rows.size()); ++i) {
    const auto& c = *rows[i].second;
    fmt::print("  {:<20} {:>12.3g} {:>10} {:>12.3g}   {:>12.3g} {:>10} {:>12.3g}\n", rows[i].first, c[0].largest,
               time_text(run, c[0].largest_at), c[0].at(end), c[1].largest, time_text(run, c[1].largest_at),
               c[1].at(end));
  }
  if (rows.size() > most) fmt::print("  ... and {} that are nearer\n", rows.size() - most);
}

std::string where(const Quantity& q) {
  return q.name.empty() && !q.worst_row.empty() ? q.worst_row + ' ' + q.worst_column : q.worst_row;
}

std::string remark(const Simulation& run, const Quantity& q) {
  std::string result;
  if (q.unlike) result += fmt::format("  not comparable in {} tick{}", q.unlike, q.unlike == 1 ? "" : "s");
  if (std::isnan(q.tolerance)) return result;
  const std::string tolerance = fmt::format("{:.3g}{}{}", q.tolerance, q.unit.empty() ? "" : " ", q.unit);
  return result + (q.beyond == Course::never ? "  within " + tolerance
                                             : "  BEYOND " + tolerance + " from " + time_text(run, q.beyond) + " on");
}

void print_quantities(const Simulation& run, const std::vector<Quantity>& all) {
  if (all.empty()) return;
  std::size_t width = 10, place = 5;
  for (const Quantity& q : all) {
    width = std::max(width, q.title().size());
    place = std::max(place, where(q).size());
  }
  fmt::print("\n  {:<{}}  {:>9} {:>10}  {:<{}}  {:>10} {:>10}\n", "difference", width, "largest", "at", "where", place,
             "at the end", "since");
  for (const Quantity& q : all) {
    const bool differs = q.first != Course::never;
    fmt::print("  {:<{}}  {:>9.3g} {:>10}  {:<{}}  {:>10.3g} {:>10}{}\n", q.title(), width, q.largest,
               time_text(run, differs ? q.largest_at : Course::never), where(q), place, q.end, time_text(run, q.first),
               remark(run, q));
  }
}

std::string listed(const std::vector<std::string>& names) {
  std::string result;
  for (const auto& name : names) result += (result.empty() ? "" : ", ") + name;
  return result;
}

void print_pair(const ComparedRun& a, const ComparedRun& b) {
  const Divergence& divergence = *b.divergence;
  const std::string span = fmt::format("to t = {}", time_text(*a.run, divergence.tick()));
  if (divergence.same()) {
    fmt::print("\n{} against {}: no difference, {}: the same bits in every table and tick\n", b.label, a.label, span);
    return;
  }
  fmt::print("\n{} against {}, {}\n", b.label, a.label, span);
  if (divergence.first())
    print_first(a, b);
  else
    fmt::print("  no difference in what both have: the same bits in every tick\n");
  std::vector<std::string> others;
  const auto all = quantities(*a.run, divergence, others);
  for (const auto& [name, table] : divergence.tables()) {
    if (table.by_row) print_rows(*a.run, name, table, divergence.tick());
  }
  print_quantities(*a.run, all);
  if (!others.empty()) fmt::print("  also differ: {}\n", listed(others));
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& only = divergence.only(i);
    if (!only.empty())
      fmt::print("  only in {}, at some time: {}\n", i == 0 ? a.label : b.label, listed({only.begin(), only.end()}));
  }
}

}  // namespace

void print_comparison(const std::vector<ComparedRun>& runs, const std::vector<std::string>& not_run) {
  fmt::print("{}\n", runs[0].run->world().name);
  print_runs(runs);
  for (const auto& words : not_run) fmt::print("  not run: {}\n", words);
  print_events(runs);
  for (const auto& r : runs) {
    if (r.divergence) print_pair(runs[0], r);
  }
  bool headed = false;
  for (const auto& r : runs) {
    for (const auto& file : r.files) fmt::print("{}  wrote {}\n", headed ? "" : "\n", file.string()), headed = true;
  }
}

namespace {

Json tick_json(uint64_t tick) { return tick == Course::never ? Json(nullptr) : Json(tick); }

Json first_json(const Simulation& run, const FirstDifference& first) {
  return {{"tick", first.tick},
          {"time", time_of(run, first.tick)},
          {"table", first.table},
          {"row", first.row},
          {"column", first.column},
          {"values", {first.value[0], first.value[1]}},
          {"writers", {first.writer[0], first.writer[1]}}};
}

Json differences_json(const Divergence& divergence) {
  Json result = Json::array();
  for (const auto& [name, table] : divergence.tables()) {
    for (const auto& [row, courses] : table.rows) {
      for (std::size_t m = 0; m < courses.size(); ++m) {
        const Course& c = courses[m];
        if (c.first == Course::never) continue;
        result.push_back({{"table", name},
                          {"row", row},
                          {"quantity", table.measures[m].name},
                          {"unit", table.measures[m].unit},
                          {"largest", c.largest},
                          {"largest_at_tick", c.largest_at},
                          {"end", c.at(divergence.tick())},
                          {"first_tick", c.first},
                          {"unlike_ticks", c.unlike},
                          {"tolerance", table.tolerance[m]},
                          {"beyond_tolerance_at_tick", tick_json(c.beyond)}});
      }
    }
  }
  return result;
}

Json run_json(const ComparedRun& r) {
  const Simulation& run = *r.run;
  Json result = {{"run", r.label},
                 {"what", r.what},
                 {"world", run.world().name},
                 {"seed", run.world().seed},
                 {"dt", run.world().dt},
                 {"ticks", run.tick()},
                 {"time", run.time()},
                 {"digest", hexadecimal(run.digest())}};
  result["error"] = r.fault ? Json(r.fault->what()) : Json(nullptr);
  result["events"] = Json::array();
  for (const auto& event : run.events())
    result["events"].push_back(
        {{"time", time_of(run, event.tick)}, {"instance", event.instance}, {"message", event.message}});
  result["files"] = Json::array();
  for (const auto& file : r.files) result["files"].push_back(file.string());
  return result;
}

}  // namespace

Json comparison_json(const std::vector<ComparedRun>& runs, const std::vector<std::string>& not_run) {
  Json result = {{"runs", Json::array()}, {"not_run", not_run}, {"comparisons", Json::array()}};
  for (const auto& r : runs) {
    result["runs"].push_back(run_json(r));
    if (!r.divergence) continue;
    const Divergence& d = *r.divergence;
    result["comparisons"].push_back({{"run", r.label},
                                     {"against", runs[0].label},
                                     {"ticks", d.tick()},
                                     {"common_random_numbers", r.run->world().seed == runs[0].run->world().seed},
                                     {"same", d.same()},
                                     {"within", d.within()},
                                     {"first", d.first() ? first_json(*r.run, *d.first()) : Json(nullptr)},
                                     {"only", {{runs[0].label, d.only(0)}, {r.label, d.only(1)}}},
                                     {"differences", differences_json(d)}});
  }
  return result;
}

}  // namespace muster::cli
