#include "diagnosis/radio/links/geometry_checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <muster/tables.hpp>
#include <set>
#include <utility>

#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

struct Plan {
  double x0 = 1e300, y0 = 1e300, x1 = -1e300, y1 = -1e300;
  bool holds(double x, double y, double margin) const {
    return x >= x0 - margin && x <= x1 + margin && y >= y0 - margin && y <= y1 + margin;
  }
};

Plan plan_of(const LinkModel& model) {
  Plan plan;
  const Table* table = model.simulation().board().find("wall/*/shape");
  for (std::size_t i = 0; table && i < table->now().rows; ++i) {
    const Wall& w = reinterpret_cast<const Wall*>(table->now().data.data())[i];
    plan.x0 = std::min({plan.x0, w.x0, w.x1}), plan.x1 = std::max({plan.x1, w.x0, w.x1});
    plan.y0 = std::min({plan.y0, w.y0, w.y1}), plan.y1 = std::max({plan.y1, w.y0, w.y1});
  }
  return plan;
}

// Throws Error if at least 10 % of places lie outside the walls' bounding box, but at most 1 % with x and y exchanged.
// Of places as the data have them: a cause of the world may turn them out of the plan. A few, such as a node of a
// network that stands outdoors, tell nothing.
void check_plan(const LinkModel& model, const Dataset& data) {
  const Plan plan = plan_of(model);
  if (plan.x1 <= plan.x0 || plan.y1 <= plan.y0) return;
  const double margin = 1;        // m
  constexpr std::size_t few = 5;  // places, each of a square metre
  std::set<std::pair<long, long>> all, outside, turned_outside;
  std::size_t first = data.rows();
  for (std::size_t row = 0; row < data.rows(); ++row) {
    for (const auto& [x, y, z] : {data.tx_at[row], data.rx_at[row]}) {
      const std::pair place(std::lround(x), std::lround(y));
      all.insert(place);
      if (!plan.holds(y, x, margin)) turned_outside.insert(place);
      if (plan.holds(x, y, margin)) continue;
      outside.insert(place);
      first = std::min(first, row);
    }
  }
  if (outside.size() < few || 10 * outside.size() < all.size() || 100 * turned_outside.size() > all.size()) return;
  throw invalid(data.table->place(first, 0),
                "row " + std::to_string(first + 1) +
                    " and others lie outside of the world's walls, and inside if x and y change "
                    "places; expected x to the east and y to the north, as in the world");
}

// True if the readings tell that radios which move are no vehicles: half of their ways, from one reading to the next,
// are faster than 100 m/s.
bool flies(const LinkModel& model, const Dataset& data) {
  constexpr double fastest = 100;   // m/s
  std::map<int, std::size_t> last;  // row of each radio
  std::size_t ways = 0, fast = 0;
  for (std::size_t row = 0; row < model.rows() && !data.t.empty(); ++row) {
    if (data.is_wild(row)) continue;
    for (std::size_t end = 0; end < 2; ++end) {
      const End& now = model.ends()[row][end];
      const auto [entry, is_first] = last.try_emplace(now.radio, row);
      if (is_first) continue;
      const auto& before = model.ends()[entry->second];
      const End& was = before[0].radio == now.radio ? before[0] : before[1];
      const double way = std::hypot(now.x - was.x, now.y - was.y), time = std::abs(data.t[row] - data.t[entry->second]);
      entry->second = row;
      if (way == 0 || time == 0) continue;
      ++ways;
      fast += way / time > fastest;
    }
  }
  return ways > 0 && 2 * fast > ways;
}

// Throws Error if at least 10 % of ends lie far outside of the walls, all of these inside as millimetres, and radios
// would move too fast in metres.
void check_scale(const LinkModel& model, const Dataset& data) {
  const Plan plan = plan_of(model);
  if (plan.x1 <= plan.x0 || plan.y1 <= plan.y0) return;
  const double size = std::max(plan.x1 - plan.x0, plan.y1 - plan.y0), margin = 1;  // m
  const auto as_millimetres = [&](double v) { return std::abs(v) > 20 * size ? v / 1000 : v; };
  std::size_t far = 0, inside = 0, first = data.rows();
  for (std::size_t row = 0; row < model.rows(); ++row) {
    for (const End& end : model.ends()[row]) {
      if (plan.holds(end.x, end.y, 20 * size)) continue;
      first = std::min(first, row);
      ++far;
      inside += plan.holds(as_millimetres(end.x), as_millimetres(end.y), margin);
    }
  }
  if (10 * far < 2 * model.rows() || 100 * inside < 99 * far || !flies(model, data)) return;
  throw invalid(
      data.table->place(first, 0),
      "row " + std::to_string(first + 1) +
          " and others lie far outside of the world's walls, and inside if their places are millimetres; expected "
          "metres (a map of muster import: rx_x[m] = 0.001*COLUMN)");
}

// True if a radio has places more than `least` metres from its first one.
bool moves(const LinkModel& model, int radio, double least) {
  const End* first = nullptr;
  for (const auto& ends : model.ends()) {
    for (const End& end : ends) {
      if (end.radio != radio) continue;
      if (!first) first = &end;
      if (std::hypot(end.x - first->x, end.y - first->y) > least) return true;
    }
  }
  return false;
}

// The radio at the other end wherever `radio` is, if it is within a metre of a place throughout; -1 if there is none.
int stands_there(const LinkModel& model, int radio, const Mount& place) {
  constexpr double near = 1;  // m
  int other = -1;
  for (const auto& ends : model.ends()) {
    for (std::size_t end = 0; end < 2; ++end) {
      if (ends[end].radio != radio) continue;
      const End& far = ends[1 - end];
      if (std::hypot(far.x - place.x, far.y - place.y) > near || (other >= 0 && far.radio != other)) return -1;
      other = far.radio;
    }
  }
  return other;
}

// True if all places of the data lie outside of the plan, and nearly all within it when moved by -dx, -dy.
bool is_moved_frame(const LinkModel& model, double dx, double dy) {
  const Plan plan = plan_of(model);
  if (plan.x1 <= plan.x0 || plan.y1 <= plan.y0) return false;
  constexpr double margin = 1, most_outside = 0.05;  // m, share
  std::size_t ends = 0, outside = 0;
  for (const auto& row : model.ends()) {
    for (const End& end : row) {
      if (plan.holds(end.x, end.y, margin)) return false;
      ++ends;
      outside += !plan.holds(end.x - dx, end.y - dy, margin);
    }
  }
  return static_cast<double>(outside) <= most_outside * static_cast<double>(ends);
}

// 0.01 or 0.001 where that times the data's place of a station is its place in the world, so that the data are in
// centimetres or millimetres; else 0. A station at the origin has no scale.
double scale_between(const End& data, const Mount& world) {
  constexpr double near = 0.1;  // of the way from the origin
  for (const double factor : {0.01, 0.001}) {
    const double x = factor * data.x, y = factor * data.y, way = std::hypot(x, y);
    if (way > 0 && std::hypot(x - world.x, y - world.y) <= near * way) return factor;
  }
  return 0;
}

// "x_column - 150" of an import map.
std::string shifted(const std::string& column, double by) {
  return column + "[m] = COLUMN " + (by < 0 ? "+ " : "- ") + print_real(std::abs(by));
}

std::string doubt_of_frame(const LinkModel& model, double dx, double dy) {
  if (!is_moved_frame(model, dx, dy)) return "";
  return "; all places of the data lie outside of the world's walls, and inside if they are moved by " +
         print_real(-dx) + ", " + print_real(-dy) +
         " m: are they of another frame? expected the plan's (a map of muster import: " + shifted("rx_x", dx) + ", " +
         shifted("rx_y", dy) + ", and tx_x, tx_y alike)";
}

// " (world.xml:7:3)", where the world has the radio.
std::string of_world(const std::vector<RowDeclaration>& rows, const std::string& name) {
  const auto row =
      std::find_if(rows.begin(), rows.end(), [&](const RowDeclaration& each) { return each.name == name; });
  return row == rows.end() || row->place.line == 0 ? "" : " (" + row->place.text() + ")";
}

std::vector<std::string> check_stations(const LinkModel& model, const Dataset& data) {
  std::vector<std::string> notes;
  const Table* mounts = model.simulation().board().find("radio/*/mount");
  std::set<int> seen;
  for (std::size_t row = 0; row < model.rows(); ++row) {
    for (const End& end : model.ends()[row]) {
      const Mount& mount = reinterpret_cast<const Mount*>(mounts->now().data.data())[end.radio];
      if (!seen.insert(end.radio).second || !std::isnan(mount.robot)) continue;
      const double off = std::hypot(end.x - mount.x, end.y - mount.y),
                   turned = std::hypot(end.y - mount.x, end.x - mount.y);
      const std::string name = model.radio_name(end.radio);
      const auto& declared = model.simulation().world().rows;
      if (std::none_of(declared.begin(), declared.end(), [&](const RowDeclaration& r) { return r.name == name; }))
        continue;
      if (off <= 1) continue;
      const auto place = [](double x, double y) { return "x = " + print_real(x) + ", y = " + print_real(y) + " m"; };
      const std::string there = place(mount.x, mount.y) + " in the world",
                        what = quote(name) + " stands at " + place(end.x, end.y) + " in the data and at " + there;
      if (turned < 0.01) throw invalid(data.table->place(row, 0), what + ": x and y are exchanged");
      if (const double scale = scale_between(end, mount); scale > 0 && !moves(model, end.radio, 0.5)) {
        const bool is_sender = &end == &model.ends()[row][0];
        const std::string from = is_sender ? "tx" : "rx", unit = scale == 0.01 ? "centimetres" : "millimetres";
        const auto column = data.table->find(from + "_x");
        notes.push_back((column ? data.table->header_place(*column) : data.table->place(row, 0)).text() + ": " + what +
                        of_world(declared, name) + ", which is the same place in " + unit +
                        "; are the data's? expected metres (a map of muster import: " + from +
                        "_x[m] = " + print_real(scale) + "*COLUMN, " + from + "_y[m] alike)");
        continue;
      }
      if (!moves(model, end.radio, 0.5)) {
        notes.push_back(data.table->place(row, 0).text() + ": " + what + of_world(declared, name) +
                        "; the data's place is used; where the data are right, correct the world to at=\"" +
                        print_real(end.x) + ' ' + print_real(end.y) + ' ' + print_real(end.z) +
                        "\", and where the world is, the table" +
                        doubt_of_frame(model, end.x - mount.x, end.y - mount.y));
        continue;
      }
      const int other = stands_there(model, end.radio, mount);
      const auto column = data.table->find("tx_x");
      const Place at = other >= 0 && column ? data.table->header_place(*column) : data.table->place(row, 0);
      notes.push_back(at.text() + ": " + quote(name) + " moves in the data and stands at " + there +
                      "; the data's places are used" +
                      (other < 0 ? ""
                                 : ", in which " + quote(model.radio_name(other)) +
                                       " stands there; are tx_x, tx_y and rx_x, rx_y exchanged in the header, or the "
                                       "names in tx and rx? (a map of muster import: tx = the column of rx, rx = that "
                                       "of tx)"));
    }
  }
  return notes;
}

}  // namespace

std::string list_of(const std::vector<std::string>& names) {
  constexpr std::size_t most = 5;
  std::string result;
  for (std::size_t k = 0; k < std::min(most, names.size()); ++k) result += (k ? ", " : "") + quote(names[k]);
  return names.size() <= most ? result : result + " and " + std::to_string(names.size() - most) + " more";
}

namespace {

// The radio of the world that a name of the data is, with the slash of a topic or in other capitals, or nearest to.
std::string meant_radio(const std::string& name, const std::vector<std::string>& silent) {
  const auto plain = [](std::string text) {
    text = text.substr(std::min(text.find_first_not_of('/'), text.size()));
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  };
  for (const std::string& each : silent)
    if (plain(each) == plain(name)) return each;
  for (const std::string& each : silent)  // a frame of ROS: "/base/radio"
    if (name.starts_with('/') && ('/' + plain(name) + '/').find('/' + plain(each) + '/') != name.npos) return each;
  return nearest(name, silent);
}

// "data.csv:2:5: ", where the radio is named first.
std::string place_of(const std::string& radio, const Dataset& data) {
  for (const auto& [column, factor] : {std::pair("tx", &data.tx), {"rx", &data.rx}}) {
    const auto at = data.table->find(column);
    const auto level = std::find(factor->levels.begin(), factor->levels.end(), radio);
    if (!at || level == factor->levels.end()) continue;
    const auto number = static_cast<uint32_t>(level - factor->levels.begin());
    const auto row = std::find(factor->level.begin(), factor->level.end(), number);
    if (row == factor->level.end()) continue;
    return data.table->place(static_cast<std::size_t>(row - factor->level.begin()), *at).text() + ": ";
  }
  return "";
}

}  // namespace

std::vector<std::string> notes_on_radios(const LinkModel& model, const Dataset& data) {
  const std::vector<std::string> added = model.added_radios();
  if (added.empty()) return {};
  std::vector<std::string> silent = model.radio_names();
  for (const Factor* heard : {&data.tx, &data.rx})
    for (const std::string& name : heard->levels) std::erase(silent, name);
  std::string meant;  // "/base" as "base"
  for (const std::string& name : added) {
    const std::string near = meant_radio(name, silent);
    if (!near.empty()) meant += (meant.empty() ? "" : ", ") + quote(name) + " as " + quote(near);
  }
  std::string words = place_of(added[0], data) + "radios of the data that the world does not have: " + list_of(added);
  if (!silent.empty()) words += "; radios of the world without a reading: " + list_of(silent);
  if (!meant.empty())
    words += "; is " + meant + " meant?" +
             (added[0].starts_with('/') ? " names have no slash (a map of muster import names them anew)" : "");
  return {words + " (as they are, a cause that is found about one adds it to the extended world)"};
}

std::vector<std::string> check_places(const LinkModel& model, const Dataset& data) {
  if (!data.has_places()) return {};  // distances alone
  check_scale(model, data);
  check_plan(model, data);
  return check_stations(model, data);
}

}  // namespace muster::diagnosis
