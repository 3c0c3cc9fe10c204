#include "rows.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "kinds.hpp"
#include "params.hpp"
#include "text/columns.hpp"
#include "text/doubts.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/paths.hpp"
#include "text/text_table.hpp"

namespace muster {
namespace {

const SetDeclaration& set_of(const Standard& standard, const std::string& name) {
  return *std::find_if(standard.sets.begin(), standard.sets.end(), [&](const auto& s) { return name == s.name; });
}

class RowReader {
 public:
  RowReader(const Standard& standard, World& world) : standard_(standard), world_(world) {}

  // First all names, so that a reference may point down the file; then all values.
  void read(const XmlElement& root) {
    for (const auto& child : root.children) {
      read_name(child, false);
      for (const auto& inside : child.children)
        if (child.name == "at") read_name(inside, true);
    }
    for (const auto& [given, element, row] : pending_) read_values(*given, *element, world_.rows[row]);
    for (const auto& load : files_) read_file_values(load);
    for (std::size_t row = 0; row < world_.rows.size(); ++row) check_whole(row);
  }

 private:
  struct Pending {
    const XmlElement* given;
    const Element* element;
    std::size_t row;
  };
  struct LoadedFile {
    const Element* element;
    TextTable table;
    std::size_t first_row;
  };

  void read_name(const XmlElement& given, bool joins_later) {
    const Element* element = find(given.name);
    if (!element) return;
    if (joins_later && (*element->file_of || set_of(standard_, element->set).kind != SetKind::live))
      throw invalid(given.place, "<" + given.name + "> stands inside <at>, but rows of " + quote(element->set) +
                                     " do not join a run; expected it in <world>" +
                                     (given.name == "wall" ? "; what opens and closes on the way is a <door> in it, by "
                                                             "<set path=\"door/NAME/state\" value=\"closed\"/>"
                                                           : ""));
    check_attributes(given, *element);
    if (*element->file_of) return add_file(given, *element);
    declare(*element, given);
    world_.rows.back().joins_later = joins_later;
  }

  const Element* find(const std::string& name) const {
    for (const auto& element : standard_.elements) {
      if (name == element.name) return &element;
    }
    return nullptr;
  }

  static void check_attributes(const XmlElement& given, const Element& element) {
    std::vector<std::string> valid;
    if (!*element.file_of) valid.push_back("name");
    for (const auto& attribute : element.attributes) {
      valid.push_back(attribute.param.name);
    }
    for (const auto& a : given.attributes) {  // before missing ones: a missing attribute may be a misspelt one
      if (std::find(valid.begin(), valid.end(), a.name) == valid.end()) refuse_unknown(a, given.name, valid);
    }
    for (const auto& attribute : element.attributes) {
      if ((attribute.param.flags & MUSTER_REQUIRED) && !given.attribute(attribute.param.name))
        throw lacking(given, attribute.param.name, expectation(attribute.param, attribute.count));
    }
    if (!given.children.empty()) refuse_inside(given);
  }

  void add_row(const Element& element, const std::string& name, const Place& place, const Place& of_name) {
    RowDeclaration row{element.set, name, {element.set}, element.own_row, place, {}};
    for (const auto& attribute : element.attributes) {
      const std::string table = attribute.table;
      const std::string set = table.substr(0, table.find('/'));
      if (!set.empty() && std::find(row.sets.begin(), row.sets.end(), set) == row.sets.end()) row.sets.push_back(set);
    }
    for (const auto& set : row.sets) {
      const auto [first, is_new] = places_.emplace(set + '/' + name, place);
      if (!is_new) refuse_second(element, set, name, place, of_name, first->second);
      numbers_[set + '/' + name] = static_cast<double>(names_[set].size());
      names_[set].push_back(name);
      rows_[set].push_back(world_.rows.size());
    }
    world_.rows.push_back(std::move(row));
    elements_.push_back(&element);
  }

  // Two elements of one kind, or of two kinds that add a row to one set: a robot and a station each have a radio.
  [[noreturn]] void refuse_second(const Element& element, const std::string& set, const std::string& name,
                                  const Place& place, const Place& at, const Place& first) const {
    const std::size_t row = rows_.at(set)[static_cast<std::size_t>(numbers_.at(set + '/' + name))];
    const std::string other = elements_[row]->name;
    if (other == element.name)
      throw invalid(place, "a second " + set + " is called " + quote(name) + "; the first is at " + first.text() +
                               "; expected another name for one of them");
    throw invalid(at, std::string(element.name) + ' ' + quote(name) + " has the name of " + other + ' ' + quote(name) +
                          " at " + first.text() + ", and each is a " + set +
                          " by its name; expected another name for " + "one of them");
  }

  // Checks that attributes fit each other, such as a wall's length above 0.
  void check_whole(std::size_t row) const {
    const RowDeclaration& declared = world_.rows[row];
    if (!elements_[row]->fault) return;
    const std::string fault =
        elements_[row]->fault(numbers_.at(declared.set + '/' + declared.name),
                              [this](const std::string& table, double number) { return cells_of(table, number); });
    if (fault.empty()) return;
    if (declared.set == "door") check_door(row);
    throw invalid(declared.place, declared.set + ' ' + quote(declared.name) + ' ' + fault);
  }

  // A door beyond its wall, with the numbers, at the attribute that says where it begins.
  void check_door(std::size_t row) const {
    const RowDeclaration& declared = world_.rows[row];
    const auto door = cells_of("door/shape", numbers_.at(declared.set + '/' + declared.name));
    const auto wall = cells_of("wall/shape", door[0]);
    const std::string& name = names_.at("wall")[static_cast<std::size_t>(door[0])];
    const double at = door[1], width = door[2], length = std::hypot(wall[2] - wall[0], wall[3] - wall[1]);
    const auto given = std::find_if(pending_.begin(), pending_.end(), [&](const Pending& p) { return p.row == row; });
    const XmlAttribute* begins = given == pending_.end() ? nullptr : given->given->attribute("at");
    const double most = rounded(length - width);
    throw invalid(begins ? begins->value_place : declared.place,
                  "door " + quote(declared.name) + " ends at " + print_real(rounded(at + width)) + " m (at " +
                      print_real(at) + " + width " + print_real(width) + ") of the wall " + quote(name) +
                      ", which is " + print_real(rounded(length)) + " m long; expected " +
                      (most >= 0 ? "at=\"" + print_real(most) + "\" or less"
                                 : "a width of at most " + print_real(rounded(length)) + " m"));
  }

  static double rounded(double metres) { return std::round(metres * 1e6) / 1e6; }

  std::vector<double> cells_of(const std::string& table, double number) const {
    const auto slash = table.find('/');
    const std::string set = table.substr(0, slash), name = table.substr(slash + 1);
    const auto& quantities = set_of(standard_, set).quantities;
    const auto quantity =
        std::find_if(quantities.begin(), quantities.end(), [&](const auto& q) { return name == q.name; });
    std::vector<double> cells(Columns(quantity->columns).size());
    for (const auto& values : world_.rows[rows_.at(set)[static_cast<std::size_t>(number)]].values) {
      if (values.table != table) continue;
      if (values.store)
        values.store(values.values.data(), cells.data());
      else
        cells = values.values;
    }
    return cells;
  }

  void declare(const Element& element, const XmlElement& given) {
    std::string name = std::string(element.set) + std::to_string(names_[element.set].size() + 1);
    const XmlAttribute* found = given.attribute("name");
    if (found) {
      check_name(*found);
      name = found->value;
    }
    add_row(element, name, given.place, found ? found->value_place : given.place);
    pending_.push_back({&given, &element, world_.rows.size() - 1});
  }

  double number_of(const std::string& set, const std::string& row, const Place& place) const {
    const auto found = numbers_.find(set + '/' + row);
    if (found != numbers_.end()) return found->second;
    const auto valid = names_.find(set);
    throw invalid(place, "no " + set + " is called " + quote(row) + which_is(world_, row, set) + "; " +
                             (valid == names_.end() ? "the world has none" : suggest(row, valid->second)));
  }

  FindRow finder() const {
    return [this](const std::string& set, const std::string& row, const Place& place) {
      return number_of(set, row, place);
    };
  }
  Warn warner() {
    return [this](const Place& place, const std::string& message) { world_.warnings.push_back({place, message}); };
  }

  // Values of attributes that are given, and the defaults of those that are not.
  void read_values(const XmlElement& given, const Element& element, RowDeclaration& row) {
    for (const auto& attribute : element.attributes) {
      const auto* found = given.attribute(attribute.param.name);
      if (!*attribute.table) {
        world_.texts[row.set + '/' + row.name + '/' + attribute.param.name] =
            found ? found->value : attribute.param.text;
        if (found)  // for messages about what it names
          world_.texts[row.set + '/' + row.name + "/place/" + attribute.param.name] = found->value_place.text();
      } else if (found) {
        refuse_pose(element, attribute, *found);
        row.values.push_back({attribute.table, attribute.store,
                              attribute_values(attribute.param, attribute.count, *found, finder(), warner()),
                              &attribute});
      } else if (attribute.param.kind != MUSTER_REFERENCE) {
        row.values.push_back({attribute.table, attribute.store,
                              std::vector<double>(static_cast<std::size_t>(attribute.count), attribute.param.value),
                              &attribute});
      }
    }
  }

  // A place with a heading behind it: x y z yaw, SDF's x y z roll pitch yaw, or x y z and a quaternion of ROS.
  static void refuse_pose(const Element& element, const Attribute& attribute, const XmlAttribute& given) {
    const auto turns = std::find_if(element.attributes.begin(), element.attributes.end(), [](const Attribute& each) {
      return each.count == 1 && std::string(each.param.unit) == "rad";
    });
    if (attribute.count != 3 || given.name != "at" || turns == element.attributes.end()) return;
    std::optional<std::vector<double>> pose;
    for (const std::size_t count : {4, 6, 7})
      if (!pose) pose = parse_reals(given.value, count);
    if (!pose) return;
    const std::vector<double>& p = *pose;
    double yaw = p.back();
    if (p.size() == 7) yaw = std::atan2(2 * (p[6] * p[5] + p[3] * p[4]), 1 - 2 * (p[4] * p[4] + p[5] * p[5]));
    const char* order = p.size() == 4 ? "x y z yaw" : p.size() == 6 ? "x y z roll pitch yaw" : "x y z qx qy qz qw";
    throw invalid(given.value_place,
                  "attribute \"at\": " + quote(given.value) + " has " + std::to_string(p.size()) + " numbers (" +
                      order + "?); expected three, x y z in m, and the heading as an attribute of its own: at=\"" +
                      print_real(p[0]) + ' ' + print_real(p[1]) + ' ' + print_real(p[2]) + "\" " + turns->param.name +
                      "=\"" + print_real(rounded(yaw)) + '"');
  }

  void add_file(const XmlElement& given, const Element& element) {
    const auto& file = *given.attribute("file");
    const auto path = world_.file.parent_path() / file.value;
    if (!std::filesystem::exists(path)) throw invalid(file.value_place, "attribute \"file\": " + no_file(path));
    files_.push_back({&element, TextTable::read(path), world_.rows.size()});
    const auto& table = files_.back().table;
    if (table.rows() == 0)
      world_.warnings.push_back({file.value_place, "attribute \"file\": " + quote(file.value) +
                                                       " has no rows below its header, so that it adds nothing"});
    const Element& one = single(element);
    const auto names = table.texts(table.require("name", ""));
    for (std::size_t r = 0; r < table.rows(); ++r) {
      const auto place = table.place(r, table.require("name", ""));
      const std::string& name = names.levels[names.level[r]];
      check_name({"name", name, place, place});
      add_row(one, name, place, place);
    }
  }

  // The element that adds single rows to the set that a file lists.
  const Element& single(const Element& element) const {
    for (const auto& other : standard_.elements) {
      if (std::string(other.set) == element.file_of && !*other.file_of) return other;
    }
    throw Error(Exit::internal, "no element adds rows to the set " + std::string(element.file_of));
  }

  // Columns are those of the set's first quantity; one may be absent where an attribute has a default for it.
  void read_file_values(const LoadedFile& load) {
    const auto& quantity = set_of(standard_, load.element->file_of).quantities[0];
    const Columns columns(quantity.columns);
    const std::string table = std::string(load.element->file_of) + '/' + quantity.name;
    std::vector<double> defaults(columns.size(), std::numeric_limits<double>::quiet_NaN());
    for (const auto& attribute : single(*load.element).attributes) {
      if (table == attribute.table && !(attribute.param.flags & MUSTER_REQUIRED) &&
          attribute.param.kind != MUSTER_REFERENCE)
        attribute.store(std::vector<double>(static_cast<std::size_t>(attribute.count), attribute.param.value).data(),
                        defaults.data());
    }
    std::vector<TextColumn> needed = {{"name", ""}};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (std::isnan(defaults[c])) needed.push_back({columns[c].name, columns[c].unit});
    }
    load.table.require_most(needed);
    std::vector<std::vector<double>> cells;
    std::set<std::string> known = {"name"};
    for (std::size_t c = 0; c < columns.size(); ++c) {
      known.insert(columns[c].name);
      const bool may_miss = !std::isnan(defaults[c]) && !load.table.find(columns[c].name);
      cells.push_back(may_miss ? std::vector<double>(load.table.rows(), defaults[c])
                               : read_column(load.table, columns[c]));
      if (!may_miss) check_bounds(load.table, single(*load.element), table, columns, c, cells.back(), world_.warnings);
    }
    for (std::size_t c = 0; c < load.table.columns().size(); ++c) {
      const auto& name = load.table.columns()[c].name;
      if (!known.count(name))
        throw invalid(load.table.header_place(c),
                      "column " + quote(name) + " means nothing here; " + suggest(name, {known.begin(), known.end()}));
    }
    for (std::size_t r = 0; r < load.table.rows(); ++r) {
      StoredValues values{table, nullptr, {}, nullptr};
      for (const auto& column : cells) values.values.push_back(column[r]);
      world_.rows[load.first_row + r].values.push_back(std::move(values));
    }
  }

  // The bounds of the attribute that gives this column where a row is an element of its own.
  void check_bounds(const TextTable& table, const Element& one, const std::string& quantity, const Columns& columns,
                    std::size_t c, const std::vector<double>& cells, std::vector<Warning>& warnings) const {
    for (const auto& attribute : one.attributes) {
      if (quantity != attribute.table || attribute.param.kind != MUSTER_REAL) continue;
      const auto plain = plain_columns(attribute, columns.size());
      if (std::find(plain.begin(), plain.end(), c) == plain.end()) continue;
      bool is_doubted = false;  // told of the first row alone
      for (std::size_t r = 0; r < cells.size(); ++r) {
        const auto at = table.require(columns[c].name, columns[c].unit);
        const std::string doubt = is_doubted ? "" : unit_doubt(columns[c].name, columns[c].unit, cells[r]);
        if (!doubt.empty()) {
          warnings.push_back({table.place(r, at), "column " + quote(columns[c].title()) + ": " + doubt});
          is_doubted = true;
        }
        if (cells[r] >= attribute.param.min && cells[r] <= attribute.param.max) continue;
        throw invalid(table.place(r, at), "column " + quote(columns[c].title()) + ": " + print_real(cells[r]) +
                                              " is out of bounds; expected " + expectation(attribute.param));
      }
    }
  }

  std::vector<double> read_column(const TextTable& table, const Column& column) const {
    const auto at = table.require(column.name, column.unit);
    if (column.reference.empty()) return table.reals(at, {column.nullable, column.infinite});
    const auto names = table.texts(at);
    std::vector<double> result;
    for (std::size_t r = 0; r < table.rows(); ++r)
      result.push_back(number_of(column.reference, names.levels[names.level[r]], table.place(r, at)));
    return result;
  }

  const Standard& standard_;
  World& world_;
  std::map<std::string, Place> places_;                    // of "set/row"
  std::map<std::string, double> numbers_;                  // of "set/row"
  std::map<std::string, std::vector<std::string>> names_;  // of a set's rows
  std::map<std::string, std::vector<std::size_t>> rows_;   // of a set, in the world
  std::vector<const Element*> elements_;                   // of each row of the world
  std::vector<Pending> pending_;
  std::vector<LoadedFile> files_;
};

}  // namespace

std::vector<std::size_t> plain_columns(const Attribute& attribute, std::size_t width) {
  constexpr double mark = 0.8125;  // a value that no sine and no sum of it reproduces
  const std::vector<double> values(static_cast<std::size_t>(attribute.count), mark);
  std::vector<double> row(width, 0);
  attribute.store(values.data(), row.data());
  std::vector<std::size_t> result;
  for (std::size_t c = 0; c < width; ++c) {
    if (row[c] == mark) result.push_back(c);
  }
  return result;
}

void read_rows(const XmlElement& root, const Standard& standard, World& world) {
  RowReader(standard, world).read(root);
}

}  // namespace muster
