#include "datagram.hpp"

#include <algorithm>

namespace muster::devices {
namespace {

using ports::FrameReader;
using ports::FrameWriter;
using ports::Kind;
using ports::Malformed;
using ports::Port;

std::string columns_of(const Port& port) {
  std::string result;
  for (const auto& column : port.columns)
    result += (result.empty() ? "" : " ") + column.title() + (column.nullable ? "?" : "") +
              (column.infinite ? "~" : "") + (column.bytes ? "{}" : "");
  return result;
}

// A text that may be printed; whatever else comes from outside is no name.
std::string printable(std::string_view text, std::size_t most) {
  const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
  if (text.empty() || text.size() > most || !std::all_of(text.begin(), text.end(), is_plain))
    throw Malformed("a name that is none, in a list of tables");
  return std::string(text);
}

constexpr std::size_t most_tables = 64, most_name = 200, most_columns = 4000;  // of a list; bytes

}  // namespace

FrameWriter begun_datagram(Kind kind, const Stamp& stamp) {
  FrameWriter frame(kind);
  frame.raw(datagram_magic);
  frame.integer(stamp.session);
  frame.integer(stamp.sequence);
  frame.integer(stamp.echo);
  frame.real(stamp.time);
  return frame;
}

Datagram parsed_datagram(std::string_view bytes) {
  FrameReader reader(bytes);
  const auto length = reader.integer<std::uint32_t>();
  if (length != reader.left())
    throw Malformed("a datagram of " + std::to_string(reader.left()) + " bytes that calls itself " +
                    std::to_string(length) + " long");
  const auto kind = reader.integer<std::uint8_t>();
  if (reader.raw(datagram_magic.size()) != datagram_magic)
    throw Malformed("a datagram that is none of " + std::string(datagram_magic));
  Datagram result{static_cast<Kind>(kind), {}, {}};
  switch (result.kind) {
    case Kind::join:
    case Kind::tables:
    case Kind::state:
    case Kind::commands:
    case Kind::bye:
    case Kind::fault:
      break;
    default:
      throw Malformed("a datagram of the kind " + std::to_string(kind));
  }
  result.stamp.session = reader.integer<std::uint64_t>();
  result.stamp.sequence = reader.integer<std::uint64_t>();
  result.stamp.echo = reader.integer<std::uint64_t>();
  result.stamp.time = reader.real();
  if (result.stamp.session == 0 || result.stamp.sequence == 0)
    throw Malformed("a datagram without a session or a sequence");
  result.body = reader.raw(reader.left());
  return result;
}

std::vector<TableShape> shapes_of(const std::vector<Port>& ports, bool gives_written) {
  std::vector<TableShape> result;
  for (const Port& port : ports) result.push_back({port.general, columns_of(port), port.is_written == gives_written});
  return result;
}

void write_tables(FrameWriter& frame, const std::vector<TableShape>& shapes) {
  frame.integer(static_cast<std::uint32_t>(shapes.size()));
  for (const TableShape& shape : shapes) {
    frame.integer<std::uint8_t>(shape.is_given);
    frame.text(shape.name);
    frame.text(shape.columns);
  }
}

std::vector<TableShape> read_tables(std::string_view body) {
  FrameReader reader(body);
  std::vector<TableShape> result;
  auto count = reader.integer<std::uint32_t>();
  if (count > most_tables) throw Malformed("a list of " + std::to_string(count) + " tables");
  for (; count > 0; --count) {
    TableShape shape;
    const auto is_given = reader.integer<std::uint8_t>();
    if (is_given > 1) throw Malformed("a table that is neither given nor taken");
    shape.is_given = is_given == 1;
    shape.name = printable(reader.text(), most_name);
    shape.columns = printable(reader.text(), most_columns);
    result.push_back(std::move(shape));
  }
  if (reader.left()) throw Malformed(std::to_string(reader.left()) + " bytes too many in a list of tables");
  return result;
}

std::string disagreement(const std::vector<TableShape>& ours, const std::vector<TableShape>& theirs,
                         const std::string& their_name) {
  const auto listed = [&](bool is_given) {
    std::string result;
    for (const TableShape& shape : theirs) {
      if (shape.is_given == is_given) result += (result.empty() ? "" : ", ") + shape.name;
    }
    return result.empty() ? std::string("none") : result;
  };
  for (const TableShape& shape : ours) {
    const auto found = std::find_if(theirs.begin(), theirs.end(), [&](const TableShape& other) {
      return other.name == shape.name && other.is_given == shape.is_given;
    });
    if (found == theirs.end())
      return their_name + (shape.is_given ? " gives no " : " takes no ") + shape.name + "; expected one of " +
             listed(shape.is_given);
    if (found->columns != shape.columns)
      return their_name + " has " + shape.name + " with the columns \"" + found->columns + "\"; expected \"" +
             shape.columns + '"';
  }
  for (const TableShape& shape : theirs) {
    const auto found = std::find_if(ours.begin(), ours.end(), [&](const TableShape& other) {
      return other.name == shape.name && other.is_given == shape.is_given;
    });
    if (found == ours.end())
      return their_name + (shape.is_given ? " gives " : " takes ") + shape.name +
             ", which this end does not exchange; expected the same tables at both ends";
  }
  return ours == theirs ? "" : their_name + " has the same tables in another order; expected one order at both ends";
}

void Sequence::restart(std::uint64_t session) {
  session_ = session;
  first_ = last_ = seen_ = 0;
}

Sequence::Taken Sequence::take(std::uint64_t sequence) {
  if (first_ == 0 || sequence > last_) {
    const std::uint64_t step = first_ == 0 ? 1 : sequence - last_;
    if (first_ == 0) first_ = sequence;
    counts_.lost += step - 1;
    seen_ = step >= window ? 0 : seen_ << step;
    seen_ |= 1;
    last_ = sequence;
    ++counts_.received;
    return Taken::fresh;
  }
  const std::uint64_t behind = last_ - sequence;
  const bool has_come = behind >= window || sequence < first_ || (seen_ >> behind & 1);
  if (behind < window && (seen_ >> behind & 1)) {
    ++counts_.duplicate;
    return Taken::duplicate;
  }
  if (behind < window) seen_ |= std::uint64_t{1} << behind;
  ++counts_.late;
  if (!has_come && counts_.lost > 0) --counts_.lost;
  return Taken::late;
}

}  // namespace muster::devices
