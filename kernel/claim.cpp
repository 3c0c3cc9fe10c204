#include "claim.hpp"

#include <algorithm>
#include <cctype>
#include <muster/row_types.hpp>

#include "file_table.hpp"
#include "text/names.hpp"
#include "text/paths.hpp"
#include "text/text_table.hpp"

namespace muster {
namespace {

std::vector<std::string> set_names(const Blackboard& board) {
  std::vector<std::string> result;
  for (const auto& [name, set] : board.sets()) {
    if (name.find('/') == std::string::npos) result.push_back(name);
  }
  return result;
}

// `; expected {robot}`, of what the plugin's parameters refer to; for one that is none, how it becomes one.
std::string expected_reference(const Instance& instance, const std::string& wrong) {
  std::vector<std::string> references;
  for (uint32_t i = 0; i < instance.plugin().param_count; ++i) {
    const muster_param& param = instance.plugin().params[i];
    if (param.kind == MUSTER_REFERENCE) references.push_back('{' + std::string(param.name) + '}');
  }
  if (!references.empty()) return "; " + suggest('{' + wrong + '}', references);
  return "; expected one there, as reference(\"" + wrong + "\", \"robot\", \"...\")";
}

// "{robot}" becomes the name of the row that the parameter `robot` refers to.
std::string substituted(const std::string& row, const Instance& instance, const Surroundings& around) {
  if (row.size() < 3 || row.front() != '{' || row.back() != '}') return row;
  const std::string param = row.substr(1, row.size() - 2);
  const int found = instance.find_param(param);
  if (found < 0 || instance.plugin().params[found].kind != MUSTER_REFERENCE)
    throw instance.refused("claims {" + param + "}, which is no reference among its parameters" +
                           expected_reference(instance, param));
  const double value = instance.params()[static_cast<std::size_t>(found)];
  if (value < 0) throw instance.refused("has no attribute " + quote(param) + ", which it needs");
  const Set& set = *around.board->find_set(instance.plugin().params[found].text);
  return set.names[static_cast<std::size_t>(value)];
}

// Of a plugin whose kind is the word of another phase than its own, such as "radio.mine" in CONTROL: "MUSTER_RADIO".
std::string phase_of_kind(const Instance& instance) {
  constexpr std::size_t enough = 4;  // letters in which "sensors" and SENSE are alike
  std::string kind = instance.declared().plugin.substr(0, enough);
  std::transform(kind.begin(), kind.end(), kind.begin(), [](unsigned char c) { return std::toupper(c); });
  for (uint32_t phase = MUSTER_ACTUATE; phase <= MUSTER_OBSERVE; ++phase) {
    const std::string name = phase_name(phase);
    if (name.substr(0, enough) == kind) return "MUSTER_" + name;
  }
  return "";
}

// A table's name that has too few parts: one of the instance's own is meant where the name is one word, and no set.
Error misnamed(const std::string& text, const Instance& instance, const Surroundings& around) {
  const bool is_own = is_name(text) && !around.board->find_set(text);
  return instance.refused("claims " + quote(text) + "; expected set/row/quantity" +
                          (is_own ? ", or " + quote("self/" + text) + " for a table of its own" : ""));
}

}  // namespace

TableName parse_table_name(const std::string& text, const Instance& instance, const Surroundings& around) {
  TableName name;
  const auto at = text.find('@');
  if (at != std::string::npos) name.part = text.substr(at + 1);
  const std::string path = text.substr(0, at);
  const auto first = path.find('/');
  const auto last = path.rfind('/');
  if (first == std::string::npos) throw misnamed(text, instance, around);
  name.quantity = path.substr(last + 1);
  if (path.compare(0, first, "self") == 0 && first == last) {
    name.set = "instance/" + instance.name();
    name.row = "*";
  } else if (first == last) {
    throw misnamed(text, instance, around);
  } else {
    name.set = path.substr(0, first);
    name.row = substituted(path.substr(first + 1, last - first - 1), instance, around);
    if (name.set == "instance") {
      name.set += '/' + name.row;
      name.row = "*";
    }
  }
  if (name.quantity.empty() || name.row.empty()) throw misnamed(text, instance, around);
  return name;
}

Set& resolve_set(const TableName& name, const Instance& instance, const Standard& standard, Blackboard& board) {
  if (Set* found = board.find_set(name.set)) return *found;
  if (const auto* known = standard_set(standard, name.set)) return board.add_set(name.set, known->kind, known->owner);
  if (name.set.compare(0, 9, "instance/") != 0)
    throw instance.refused("claims a table of the set " + quote(name.set) + "; " + suggest(name.set, set_names(board)));
  Set& own = board.add_set(name.set, SetKind::fixed, "");
  own.add(name.set.substr(9));
  return own;
}

int resolve_row(const TableName& name, const Set& set, const Instance& instance) {
  if (name.row == "*") return -1;
  const Set* rows = &set;
  if (set.kind == SetKind::listed)
    throw instance.refused("claims one row of " + quote(set.name) +
                           ", whose rows are listed anew each tick; expected *");
  const int row = rows->find(name.row);
  if (row < 0)
    throw instance.refused("claims a row of " + set.name + " called " + quote(name.row) + "; " +
                           suggest(name.row, set.names));
  return row;
}

void check_references(const Claim& claim, const Instance& instance, const Blackboard& board) {
  for (const auto& column : claim.columns) {
    if (column.reference.empty() || board.find_set(column.reference)) continue;
    throw instance.refused("claims " + quote(claim.name.text()) + ": column " + quote(column.name) +
                           " refers to the set " + quote(column.reference) + "; " +
                           suggest(column.reference, set_names(board)));
  }
}

TableName table_of(const Condition& condition) {
  const std::string& path = condition.path;
  const auto column = path.rfind('/');
  const auto quantity = column == path.npos || column == 0 ? path.npos : path.rfind('/', column - 1);
  if (quantity == path.npos) return {path, "*", "", ""};
  std::string set = path.substr(0, path.find('/'));
  if (set == "instance") set = path.substr(0, quantity);
  return {set, "*", path.substr(quantity + 1, column - quantity - 1), ""};
}

const SetDeclaration* standard_set(const Standard& standard, const std::string& set) {
  for (const auto& known : standard.sets) {
    if (set == known.name) return &known;
  }
  return nullptr;
}

const Quantity* standard_quantity(const Standard& standard, const TableName& name) {
  const auto* set = standard_set(standard, name.set);
  if (!set) return nullptr;
  for (const auto& quantity : set->quantities) {
    if (name.quantity == quantity.name) return &quantity;
  }
  return nullptr;
}

namespace {

bool is_own(const Claim& claim, const Instance& instance) {
  return claim.file || claim.name.set == "instance/" + instance.name();
}

// True for what no robot senses: others' own tables, and standard quantities of the world itself.
bool is_truth(const Claim& claim, const Instance& instance, const Standard& standard) {
  if (is_own(claim, instance)) return false;
  const auto* quantity = standard_quantity(standard, claim.name);
  return claim.name.set.compare(0, 9, "instance/") == 0 || (quantity && !quantity->sensed);
}

// True for a standard quantity that a controller writes and muster's own plugins obey: a robot's commands.
bool is_command(const Claim& claim, const Standard& standard) {
  const auto* quantity = standard_quantity(standard, claim.name);
  const auto* set = standard_set(standard, claim.name.set);
  return quantity && quantity->sensed && *quantity->user && set->kind == SetKind::live && claim.kind == MUSTER_WRITE;
}

// `expected read<Odometry>("robot/{robot}/odometry") in its place; of all: robot/command, robot/odometry, ...`
std::string expected_sensed(const Claim& claim, const Standard& standard) {
  std::string sensed;
  for (const auto& set : standard.sets) {
    for (const auto& q : set.quantities) {
      if (q.sensed) sensed += (sensed.empty() ? "" : ", ") + std::string(set.name) + '/' + q.name;
    }
  }
  const auto* quantity = standard_quantity(standard, claim.name);
  return "a controller knows what its robot senses: expected " +
         (quantity && *quantity->felt ? std::string("in its place ") + quantity->felt + "; or another of "
                                      : "one of ") +
         sensed;
}

// Refuses an instance of another phase that reads truth and writes a robot's command: it is a controller all the same.
void check_disguise(const Claim& claim, const Instance& instance, const Standard& standard) {
  const auto reads_truth = [&](const Claim& c) {
    return c.kind == MUSTER_READ && (is_truth(c, instance, standard) || (!is_own(c, instance) && !c.name.part.empty()));
  };
  const auto& claims = instance.claims();
  const Claim *truth = nullptr, *command = nullptr;
  const auto look_at = [&](const Claim& c) {
    if (!truth && reads_truth(c)) truth = &c;
    if (!command && is_command(c, standard)) command = &c;
  };
  for (const Claim& each : claims) look_at(each);
  look_at(claim);
  if (!truth || !command) return;
  throw instance.refused("claims " + quote(truth->name.text()) + ", which is truth, and writes " +
                         quote(command->name.text()) + ", which makes it a controller, whatever its phase; " +
                         expected_sensed(*truth, standard));
}

// `write<Command>("robot/{robot}/command")`, as the source is to have it.
std::string own_row_of(const Claim& claim) {
  const char* how = claim.kind == MUSTER_READ ? "read" : claim.kind == MUSTER_ADD ? "add" : "write";
  const std::string type = row_type(claim.columns.text());
  return std::string(claim.kind == MUSTER_MODIFY ? "modify" : how) + (type.empty() ? "<...>" : '<' + type + '>') +
         "(\"" + claim.name.set + "/{robot}/" + claim.name.quantity + "\")";
}

}  // namespace

// Private tables are the instance's own memory. Quantities that are not standard are checked when the world is linked,
// since the writer's claim decides.
void check_blindness(const Claim& claim, const Instance& instance, const Surroundings& around) {
  if (instance.phase() != MUSTER_CONTROL) return check_disguise(claim, instance, *around.standard);
  if (is_own(claim, instance)) return;
  const int robot = instance.bound_row();
  const std::string what = "claims " + quote(claim.name.text());
  if (is_truth(claim, instance, *around.standard)) {
    const std::string meant = phase_of_kind(instance);
    throw instance.refused(what + ", which is truth; " +
                           (meant.empty() ? expected_sensed(claim, *around.standard)
                                          : "its source states phase = MUSTER_CONTROL, in which a plugin has what its "
                                            "robot senses and no more; expected phase = " +
                                                meant));
  }
  if (claim.kind == MUSTER_READ && !claim.name.part.empty())
    throw instance.refused("claims " + quote(claim.name.text()) +
                           ", which is truth; a controller reads what comes out of the last stage");
  const std::string own = robot < 0 ? "" : around.board->find_set("robot")->names[static_cast<std::size_t>(robot)];
  if (robot >= 0 && claim.name.row != own)
    throw instance.refused(what + ", but it is bound to the robot " + quote(own) + "; expected that robot's own row, " +
                           own_row_of(claim) + " in its source");
}

namespace {

std::string as_type(const std::string& type) { return type.empty() ? "" : ", those of " + type; }

// `, those of Odometry: expected read<Odometry>("robot/{robot}/odometry")`.
std::string by_type(const Claim& claim, const std::string& type) {
  static const char* calls[] = {"", "read", "write", "add", "modify"};
  if (type.empty()) return "";
  const bool is_optional = claim.kind == MUSTER_READ && (claim.flags & MUSTER_OPTIONAL);
  return as_type(type) + "; expected " + calls[claim.kind] + (is_optional ? "_if_any" : "") + '<' + type +
         ">(...) there";
}

}  // namespace

int Instance::claim(uint32_t kind, uint32_t flags, const std::string& table, const std::string& columns) {
  Claim made;
  made.kind = kind;
  made.flags = flags;
  made.name = parse_table_name(table, *this, around_);
  if (kind < MUSTER_READ || kind > MUSTER_MODIFY)
    throw refused("claims " + quote(table) + " in a way that does not exist");
  try {
    made.columns = Columns(columns);
  } catch (const std::invalid_argument& e) {
    throw refused("claims " + quote(table) + ": " + e.what());
  }
  if (made.columns.size() == 0) throw refused("claims " + quote(table) + " without columns");
  check_references(made, *this, *around_.board);
  Set& set = resolve_set(made.name, *this, *around_.standard, *around_.board);
  // A queue's rows are numbered; their owners are named.
  made.row = resolve_row(made.name, set.kind == SetKind::queue ? *around_.board->find_set(set.owner) : set, *this);
  if (kind == MUSTER_MODIFY && set.kind == SetKind::queue && made.row >= 0)
    throw refused("modifies " + quote(table) + "; expected a whole queue");
  const bool numbers = std::all_of(made.columns.begin(), made.columns.end(), [](const Column& c) {
    return !c.nullable && !c.infinite && !c.bytes && c.reference.empty();
  });
  if (kind == MUSTER_ADD && (set.kind == SetKind::queue || made.row >= 0 || !numbers))
    throw refused("adds to " + quote(table) + "; expected a whole table of numbers");
  const auto* quantity = standard_quantity(*around_.standard, made.name);
  if (quantity && Columns(quantity->columns) != made.columns)
    throw refused("claims " + quote(table) + " as \"" + columns + "\"" + as_type(row_type(columns)) +
                  "; its columns are \"" + quantity->columns + '"' + by_type(made, row_type(quantity->columns)));
  if (kind == MUSTER_WRITE && (flags & MUSTER_JOINS) && set.kind != SetKind::live)
    throw refused("claims " + quote(table) + " to let rows join, but the rows of " + quote(set.name) + " do not join");
  check_blindness(made, *this, around_);
  claims_.push_back(std::move(made));
  return static_cast<int>(claims_.size()) - 1;
}

int Instance::file(const std::string& param, const std::string& columns) {
  const int found = find_param(param);
  if (found < 0 || plugin_->params[found].kind != MUSTER_FILE)
    throw Error(Exit::plugin_fault,
                title() + ": asks for the file " + quote(param) + ", which is no file among its parameters");
  const std::string& given = texts_[param];
  if (given.empty())
    throw refused("has no attribute " + quote(param) + ", which it needs; expected a path relative to the world file");
  const bool filled = columns.ends_with(" +"), closed = filled || columns.ends_with(" .");
  const std::string names = columns.substr(0, columns.size() - (closed ? 2 : 0));
  auto path = std::filesystem::path(given);
  if (path.is_relative()) path = around_.world->file.parent_path() / path;
  if (!std::filesystem::exists(path))
    throw invalid(places_.count(param) ? places_[param] : declared_.place,
                  "attribute " + quote(param) + ": " + no_file(path) + "; expected a table with the columns " + names);
  Claim made;
  made.kind = MUSTER_READ;
  made.columns = Columns(names);
  made.name = {"file", param, given, ""};
  check_references(made, *this, *around_.board);
  made.file = read_file_table(path, made.columns, closed, *around_.board, *around_.tables);
  for (const std::string& unread : unread_columns(path, made.columns, *around_.tables))
    events.push_back("warning: " + unread);
  for (const std::string& doubt : doubtful_cells(path, made.columns, *made.file, *around_.tables))
    events.push_back("warning: " + doubt);
  if (filled && made.file->rows == 0)
    throw invalid({path.string(), 1, 1}, "has no rows below its header; expected one at least");
  claims_.push_back(std::move(made));
  return static_cast<int>(claims_.size()) - 1;
}

}  // namespace muster
