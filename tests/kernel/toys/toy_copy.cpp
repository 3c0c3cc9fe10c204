// out = (one input + another + its last output) * times + add, with tables, columns and kind of claim from the world.
// Built once for each phase.
#include <algorithm>
#include <cstdlib>
#include <muster/plugin.hpp>

namespace {

using namespace muster;

struct Cell {
  double value;
};

struct Copy {
  static constexpr auto id = TOY_ID "/1", summary = "copies tables", cannot_hold = "a tune";
  static constexpr auto phase = TOY_PHASE;
  static constexpr Param params[] = {
      text("from", "", "a table to read"),
      text("and", "", "another"),
      text("to", "", "the table to write"),
      text("columns", "value", "columns of the table written"),
      text("from_columns", "", "columns of those read, where they differ"),
      choice("as", "write|add|modify", "the kind of claim"),
      integer("flags", 0, 0, 31, "flags of that claim"),
      integer("read_flags", 0, 0, 31, "flags of the reads"),
      flag("own", false, "start from what was written last"),
      real("add", 0, -1e6, 1e6, "m", "added to each cell").free(),
      real("times", 1, -1e6, 1e6, "", "then multiplied"),
      reference("robot", "robot", "whom it serves"),
  };

  explicit Copy(Setup& s) : times(s.value("times")), plus(s.value("add")), own(s.value("own")) {
    const std::string columns = s.text("columns"), others = s.text("from_columns");
    const auto claim = [&](uint32_t how, uint32_t flags, const std::string& table, const std::string& as) {
      if (table.empty()) return -1;
      const int index = s.host()->claim(s.host(), how, flags, table.c_str(), as.c_str());
      if (index < 0) throw std::runtime_error("");
      return index;
    };
    const auto flags = static_cast<uint32_t>(s.param("flags")),
               read_flags = static_cast<uint32_t>(s.param("read_flags"));
    from = claim(MUSTER_READ, read_flags, s.text("from"), others.empty() ? columns : others);
    other = claim(MUSTER_READ, read_flags, s.text("and"), others.empty() ? columns : others);
    kind = s.param("as") == 0 ? MUSTER_WRITE : s.param("as") == 1 ? MUSTER_ADD : MUSTER_MODIFY;
    to = claim(kind, flags, s.text("to"), columns);
    width = static_cast<std::size_t>(std::count(columns.begin(), columns.end(), ' ')) + 1;
  }

  void step(const Step& k) const {
    if (to < 0) return;
    const auto rows = k[Out<Cell>{to}];  // of `width` cells each, whatever the table is
    const auto cells = [&](int claim) { return k[In<Cell>{claim < 0 ? to : claim}]; };
    Cell* const out = rows.begin();
    const Cell *last = cells(to).begin(), *a = cells(from).begin(), *b = cells(other).begin();
    const std::size_t of_a = cells(from).size() * width, of_b = cells(other).size() * width;
    for (std::size_t i = 0; i < rows.size() * width; ++i) {
      double value = kind == MUSTER_MODIFY || k[own] != 0 ? last[i].value : 0;
      if (from >= 0 && i < of_a) value += a[i].value;
      if (other >= 0 && i < of_b) value += b[i].value;
      out[i].value = value * k[times] + k[plus];
    }
  }

  Value times, plus, own;
  int from, other, to;
  uint32_t kind;
  std::size_t width;
};

}  // namespace

MUSTER_PLUGIN_IS(Copy)
