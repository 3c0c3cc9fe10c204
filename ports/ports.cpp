#include "ports/ports.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <muster/sets.hpp>

namespace muster::ports {
namespace {

// One word of a table's columns, "range[m]*682?"; the kernel has checked the form.
void add_columns(std::string_view word, std::vector<PortColumn>& columns) {
  PortColumn column;
  std::size_t count = 1;
  const auto marks = std::min(word.find_first_of(":[{*?~+"), word.size());
  column.name = word.substr(0, marks);
  for (std::string_view rest = word.substr(marks); !rest.empty();) {
    std::size_t used = 1;
    if (rest[0] == ':') {
      used = std::min(rest.find_first_of("[{*?~+", 1), rest.size());
      column.reference = rest.substr(1, used - 1);
    } else if (rest[0] == '[') {
      used = rest.find(']') + 1;
      column.unit = rest.substr(1, used - 2);
    } else if (rest[0] == '*') {
      used = static_cast<std::size_t>(std::from_chars(rest.data() + 1, rest.data() + rest.size(), count).ptr -
                                      rest.data());
    } else if (rest[0] == '{') {
      used = 2;
    }
    column.nullable |= rest[0] == '?';
    column.infinite |= rest[0] == '~';
    column.bytes |= rest[0] == '{';
    rest.remove_prefix(used);
  }
  for (std::size_t i = 0; i < count; ++i) {
    columns.push_back(column);
    if (count > 1) columns.back().name += std::to_string(i);
  }
}

struct Word {
  std::string table, columns;
};

// "robot/a/odometry robot/a/own(x[m] y[m])" taken apart.
std::vector<Word> words_of(const std::string& text, const std::string& attribute) {
  std::vector<Word> result;
  const std::string blanks = " \t\r\n";
  for (auto at = text.find_first_not_of(blanks); at != text.npos; at = text.find_first_not_of(blanks, at)) {
    const auto end = std::min(text.find_first_of(blanks + '(', at), text.size());
    Word word{text.substr(at, end - at), ""};
    at = end;
    if (at < text.size() && text[at] == '(') {
      const auto close = text.find(')', at);
      if (close == text.npos)
        throw BadInput("attribute \"" + attribute + "\": " + word.table + '(' + " has no closing )");
      word.columns = text.substr(at + 1, close - at - 1);
      at = close + 1;
    }
    result.push_back(std::move(word));
  }
  return result;
}

struct Known {
  const SetDeclaration* set = nullptr;
  const Quantity* quantity = nullptr;
};

Known known_table(const std::string& set, const std::string& quantity) {
  for (const auto& one : standard().sets) {
    if (set != one.name) continue;
    for (const auto& each : one.quantities) {
      if (quantity == each.name) return {&one, &each};
    }
    return {&one, nullptr};
  }
  return {};
}

// The quantity that has `word` for another name, or that begins with it; "" if there is none.
std::string meant_quantity(const SetDeclaration& set, const std::string& word) {
  for (const auto& each : set.quantities) {
    if ((' ' + std::string(each.also) + ' ').find(' ' + word + ' ') != std::string::npos) return each.name;
  }
  for (const auto& each : set.quantities) {
    if (!word.empty() && std::string(each.name).rfind(word, 0) == 0) return each.name;
  }
  return "";
}

Port claimed(const muster_host* host, const Word& word, const Asked& asked, int robot) {
  const std::string attribute = asked.attribute;
  const auto first = word.table.find('/'), last = word.table.rfind('/');
  if (first == word.table.npos || first == last)
    throw BadInput("attribute \"" + attribute + "\": \"" + word.table +
                   "\" is no table; expected set/row/quantity, such as robot/{robot}/" + asked.example);
  const std::string set = word.table.substr(0, first), row = word.table.substr(first + 1, last - first - 1);
  const Known known = known_table(set, word.table.substr(last + 1));
  const std::string columns = word.columns.empty() && known.quantity ? known.quantity->columns : word.columns;
  if (columns.empty() && known.set)
    if (const std::string meant = meant_quantity(*known.set, word.table.substr(last + 1)); !meant.empty())
      throw BadInput("attribute \"" + attribute + "\": \"" + word.table + "\" is no standard table; did you mean " +
                     set + '/' + row + '/' + meant + "? a table of your own has its columns behind it, such as " +
                     word.table + "(x[m] y[m])");
  if (columns.empty())
    throw BadInput("attribute \"" + attribute + "\": \"" + word.table +
                   "\" is no standard table; expected its columns behind it, such as " + word.table + "(x[m] y[m])");
  Port port;
  port.is_written = asked.is_written;
  port.is_queue = known.set && known.set->kind == SetKind::queue;
  port.has_one_owner = port.is_queue && row != "*";
  if (row == "*" && !port.is_queue) port.set = set;
  port.claim = host->claim(host, asked.is_written ? MUSTER_WRITE : MUSTER_READ, asked.flags, word.table.c_str(),
                           columns.c_str());
  if (port.claim < 0) throw std::runtime_error("");  // the kernel has the message
  port.table = port.general = word.table;
  const std::string own = robot >= 0 ? host->row_name(host, "robot", static_cast<uint32_t>(robot)) : "";
  if (row == "{robot}" && robot >= 0) port.table = set + '/' + own + word.table.substr(last);
  if (row == own && robot >= 0) port.general = set + "/{robot}" + word.table.substr(last);
  for (std::size_t at = 0; at < columns.size();) {
    const auto end = std::min(columns.find(' ', at), columns.size());
    if (end > at) add_columns(std::string_view(columns).substr(at, end - at), port.columns);
    at = end + 1;
  }
  return port;
}

// True for a column whose cells mean rows of another set. That of a queue's one owner is known without it.
bool is_named(const Port& port, uint32_t column) {
  return !port.columns[column].reference.empty() && !(column == 0 && port.has_one_owner);
}

std::size_t byte_columns(const Port& port) {
  return static_cast<std::size_t>(
      std::count_if(port.columns.begin(), port.columns.end(), [](const PortColumn& c) { return c.bytes; }));
}

}  // namespace

std::vector<Port> claimed_ports(const muster_host* host, const Asked& asked, int robot) {
  const char* text = host->text(host, asked.attribute);
  std::vector<Port> result;
  for (const auto& word : words_of(text ? text : "", asked.attribute))
    result.push_back(claimed(host, word, asked, robot));
  return result;
}

bool is_off() {
  const char* word = std::getenv("MUSTER_BRIDGE");
  return word && std::string_view(word) == "off";
}

std::vector<std::string> sets_of(const std::vector<Port>& ports) {
  std::vector<std::string> result;
  const auto add = [&](const std::string& set) {
    if (!set.empty() && std::find(result.begin(), result.end(), set) == result.end()) result.push_back(set);
  };
  for (const auto& port : ports) {
    add(port.set);
    for (const auto& column : port.columns) add(column.reference);
  }
  return result;
}

void write_rows(FrameWriter& frame, const Port& port, const muster_host* host, const muster_in& in,
                References references) {
  frame.integer(in.rows);
  for (std::size_t i = 0; i < std::size_t{in.rows} * in.cols; ++i) frame.real(in.data[i]);
  for (uint32_t r = 0; byte_columns(port) && r < in.rows; ++r) {
    for (uint32_t c = 0; c < in.cols; ++c) {
      if (!port.columns[c].bytes) continue;
      uint64_t count = 0;
      const uint8_t* data = host->get_bytes(host, port.claim, r, c, &count);
      frame.text({reinterpret_cast<const char*>(data), static_cast<std::size_t>(count)});
    }
  }
  for (uint32_t r = 0; references == References::names && r < in.rows; ++r) {
    for (uint32_t c = 0; c < in.cols; ++c) {
      if (!is_named(port, c)) continue;
      const double row = in.data[std::size_t{r} * in.cols + c];
      const char* name =
          row >= 0 ? host->row_name(host, port.columns[c].reference.c_str(), static_cast<uint32_t>(row)) : nullptr;
      frame.text(name ? name : "");
    }
  }
}

GivenRows::GivenRows(FrameReader& frame, const Port& port, const muster_host* host, uint32_t rows_expected,
                     References references)
    : port_(&port), rows_(frame.integer<uint32_t>()) {
  if (!port.is_queue && rows_ != rows_expected)
    throw Malformed(std::to_string(rows_) + " rows of " + port.table + "; expected " + std::to_string(rows_expected));
  const std::size_t count = std::size_t{rows_} * port.columns.size();
  if (count > frame.left() / sizeof(double))
    throw Malformed(std::to_string(rows_) + " rows of " + port.table + " in a frame that ends before them");
  cells_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double value = frame.real();
    cells_.push_back(std::isnan(value) ? null() : value);  // one bit pattern is null; clients may have others
  }
  for (std::size_t i = 0; i < rows_ * byte_columns(port); ++i) bytes_.emplace_back(frame.text());
  if (references == References::names) name_rows(frame, host);
  check(host);
}

// Cells that mean rows of other sets: the rows of those names here.
void GivenRows::name_rows(FrameReader& frame, const muster_host* host) {
  const std::size_t width = port_->columns.size();
  std::vector<uint32_t> strangers;
  for (uint32_t r = 0; r < rows_; ++r) {
    for (uint32_t c = 0; c < width; ++c) {
      if (!is_named(*port_, c)) continue;
      const std::string name(frame.text()), set = port_->columns[c].reference;
      double& cell = cells_[r * width + c] = null();
      for (uint32_t row = 0; row < host->rows(host, set.c_str()); ++row) {
        if (host->row_name(host, set.c_str(), row) == name) cell = row;
      }
      if (!std::isnan(cell) || (name.empty() && port_->columns[c].nullable)) continue;
      if (!port_->is_queue) throw Malformed("a " + set + " that this world does not have, in " + port_->table);
      if (strangers.empty() || strangers.back() != r) strangers.push_back(r);
    }
  }
  for (auto r = strangers.rbegin(); r != strangers.rend(); ++r) leave_out(*r);
}

void GivenRows::leave_out(uint32_t row) {
  const auto width = static_cast<std::ptrdiff_t>(port_->columns.size());
  const auto texts = static_cast<std::ptrdiff_t>(byte_columns(*port_));
  cells_.erase(cells_.begin() + row * width, cells_.begin() + (row + 1) * width);
  bytes_.erase(bytes_.begin() + row * texts, bytes_.begin() + (row + 1) * texts);
  --rows_;
  ++left_out_;
}

void GivenRows::check(const muster_host* host) const {
  const auto& columns = port_->columns;
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const PortColumn& column = columns[i % columns.size()];
    const bool is_owner = port_->has_one_owner && i % columns.size() == 0;
    if (column.bytes || is_owner) continue;  // set() fills these
    const double value = cells_[i];
    const auto refuse = [&](const std::string& found, const std::string& expected) {
      throw Malformed(found + " as " + column.title() + " of " + port_->table + "; expected " + expected);
    };
    if (std::isnan(value)) {
      if (!column.nullable) refuse("NaN", "a number");
    } else if (std::isinf(value) && !column.infinite) {
      refuse("an infinite number", "a finite one");
    } else if (!column.reference.empty()) {
      const uint32_t rows = host->rows(host, column.reference.c_str());
      if (!(value >= 0 && value < rows && value == std::floor(value)))
        refuse("the row " + std::string(value == std::floor(value) ? "outside of " : "between those of ") +
                   column.reference,
               "a whole number below " + std::to_string(rows));
    }
  }
}

void GivenRows::set(const muster_host* host, const muster_out& out, uint32_t first) const {
  const std::size_t width = port_->columns.size();
  double* rows = port_->is_queue ? rows_ ? host->append(host, port_->claim, rows_) : nullptr : out.data;
  auto bytes = bytes_.begin();
  for (uint32_t r = 0; r < rows_; ++r) {
    for (uint32_t c = 0; c < width; ++c) {
      if (port_->columns[c].bytes) {
        host->put_bytes(host, port_->claim, first + r, c, reinterpret_cast<const uint8_t*>(bytes->data()),
                        bytes->size());
        ++bytes;
      } else if (!(c == 0 && port_->has_one_owner)) {
        rows[r * width + c] = cells_[r * width + c];
      }
    }
  }
}

void set_rest(const Port& port, const muster_out& out) {
  if (port.is_queue) return;
  for (std::size_t i = 0; i < std::size_t{out.rows} * out.cols; ++i)
    out.data[i] = port.columns[i % out.cols].nullable ? null() : 0.0;
}

void set_last(const Port& port, const muster_in& last, const muster_out& out) {
  if (!port.is_queue) std::copy_n(last.data, std::size_t{out.rows} * out.cols, out.data);
}

std::string seconds_text(double seconds) {
  char digits[32];
  return std::string(digits, std::to_chars(digits, digits + sizeof digits, seconds).ptr) + " s";
}

}  // namespace muster::ports
