// Writers without effect, such as a command under the name that ROS has for it, and commands that come too late.
#include <algorithm>
#include <muster/row_types.hpp>

#include "claim.hpp"
#include "link.hpp"
#include "text/names.hpp"
#include "text/synonyms.hpp"

namespace muster {
namespace {

bool is_write(const Claim& claim) {
  return (claim.kind == MUSTER_WRITE && !(claim.flags & MUSTER_JOINS)) || claim.kind == MUSTER_ADD;
}

bool is_private(const TableName& name) { return name.set.compare(0, 9, "instance/") == 0; }

// "{robot}" where a parameter of that name names the claimed row, as the source is to have it; else the row itself.
std::string row_in_source(const Instance& instance, const TableName& name, const Blackboard& board) {
  for (uint32_t i = 0; i < instance.plugin().param_count; ++i) {
    const muster_param& param = instance.plugin().params[i];
    const double value = instance.params()[i];
    const Set* set = param.kind == MUSTER_REFERENCE && value >= 0 ? board.find_set(param.text) : nullptr;
    if (set && set->names[static_cast<std::size_t>(value)] == name.row) return '{' + std::string(param.name) + '}';
  }
  return name.row;
}

// What somebody else may give in its place: commands and messages of a controller, and all tables of another plugin.
bool may_write(const Instance& instance, const Quantity& quantity) {
  return instance.phase() > MUSTER_ACTUATE || !*quantity.provider;
}

}  // namespace

// True where a plugin, a record or a condition of the world reads the table, or a stage passes it on.
bool Linker::is_heard(const std::string& logical) const {
  const auto found = claimed_.find(logical);
  if (found != claimed_.end() && (!found->second.readers.empty() || !found->second.modifiers.empty())) return true;
  return std::any_of(world_.records.begin(), world_.records.end(),
                     [&](const auto& record) { return record.table == logical; }) ||
         std::any_of(world_.occasions.begin(), world_.occasions.end(), [&](const auto& occasion) {
           return occasion.when && table_of(*occasion.when).logical() == logical;
         });
}

// True of a table that is not muster's, has no reader, and is not one of those that unread() tells of by themselves.
bool Linker::is_unheard(const Instance& instance, const Claim& claim) const {
  return is_write(claim) && instance.phase() < MUSTER_SENSE && !is_private(claim.name) &&
         !standard_quantity(standard_, claim.name) && !is_heard(claim.name.logical());
}

// The standard table of the set that the writer means: by its name, in ROS or misspelt, or by its columns.
std::string Linker::meant_table(const Instance& instance, const Claim& claim) const {
  const SetDeclaration* set = standard_set(standard_, claim.name.set);
  if (!set) return "";
  const std::string begin = claim.name.set + "/*/";
  const auto& claims = instance.claims();
  std::vector<std::string> read, known;
  std::string alike;
  for (const Quantity& each : set->quantities) {
    const bool is_given = std::any_of(claims.begin(), claims.end(), [&](const Claim& own) {
      return is_write(own) && own.name.logical() == begin + each.name;
    });
    const bool is_asked = std::any_of(claims.begin(), claims.end(), [&](const Claim& own) {
      return own.kind == MUSTER_READ && own.name.logical() == begin + each.name;
    });
    if (is_given || is_asked || !may_write(instance, each)) continue;
    if (*each.user) known.push_back(begin + each.name);
    if (!is_heard(begin + each.name)) continue;
    read.push_back(begin + each.name);
    if (alike.empty() && Columns(each.columns) == claim.columns) alike = begin + each.name;
  }
  for (const auto* names : {&read, &known}) {
    std::string meant = synonym(claim.name.quantity, *names);
    if (meant.empty()) meant = nearest(claim.name.logical(), *names);
    if (!meant.empty()) return meant;
    if (!alike.empty()) return alike;
  }
  return "";
}

// Tables that a plugin writes for others and that reach nobody: where another one is meant, and where a controller
// writes no more than these, so that it has no effect at all. Plugins of other phases may tell by events what they
// find.
void Linker::tell_unheard(std::vector<std::string>& told) const {
  for (Instance* instance : instances_) {
    const auto& claims = instance->claims();
    const bool has_effect = std::any_of(claims.begin(), claims.end(), [&](const Claim& each) {
      return !each.file && each.kind != MUSTER_READ && !is_private(each.name) && !is_unheard(*instance, each);
    });
    for (std::size_t i = 0; i < claims.size(); ++i) {
      const Claim& claim = claims[i];
      if (!is_unheard(*instance, claim) || is_for_others({instance, i})) continue;
      const std::string meant = meant_table(*instance, claim);
      if (meant.empty() && (has_effect || instance->phase() > MUSTER_ACTUATE)) continue;
      const std::string begin = instance->title() + ": writes " + quote(claim.name.text()) + ", which nobody reads";
      if (meant.empty()) {
        told.push_back(begin + ", so that it has no effect; expected a table that somebody reads, or <record table=\"" +
                       claim.name.logical() + "\"/>");
        continue;
      }
      const auto& readers = claimed_.count(meant) ? claimed_.at(meant).readers : std::vector<Claimed::By>();
      const std::string own =
          claim.name.set + '/' + row_in_source(*instance, claim.name, board_) + meant.substr(meant.rfind('/'));
      told.push_back(begin + "; did you mean " + own +
                     (readers.empty() ? "?" : ", which " + readers[0].instance->declared().plugin + " reads?"));
      break;  // one that is mended may mend the others
    }
  }
}

// Commands that are written when those who obey them have had their turn: they act in the tick after.
void Linker::tell_late(std::vector<std::string>& told) const {
  for (const auto& [logical, c] : claimed_) {
    for (const auto& writer : c.writers) {
      const Claim& claim = writer.get();
      const Quantity* command = standard_quantity(standard_, claim.name);
      const Set* set = board_.find_set(claim.name.set);
      if (!command || !command->sensed || !*command->user || !set || set->kind != SetKind::live) continue;
      const auto before = std::find_if(c.readers.begin(), c.readers.end(), [&](const Claimed::By& reader) {
        return reader.instance->phase() < writer.instance->phase();
      });
      if (before == c.readers.end()) continue;
      const std::string plugin = writer.instance->declared().plugin;
      told.push_back(writer.instance->title() + ": writes " + quote(claim.name.text()) + " in the phase " +
                     phase_name(writer.instance->phase()) + ", when " + before->instance->title() +
                     " has read it already, so that it acts a tick late; expected phase = MUSTER_CONTROL in the source "
                     "of " +
                     plugin);
    }
  }
}

}  // namespace muster
