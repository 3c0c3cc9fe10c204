// Drives robots of a muster run from outside: a client of the plugin bridge.socket. C++17, this header alone.
//
//   muster_client::Client run = muster_client::connect(47474);
//   while (run.next()) {
//     const auto here = run.row("robot/rover/odometry");       // here["x"], or here[0]
//     for (const auto& message : run.rows("inbox/rover/message"))
//       std::cout << message.name("from") << ": " << message.bytes("payload") << '\n';
//     run.set("robot/rover/command", {0.3, 0.1});              // v in m/s, w in rad/s
//     run.send("outbox/rover/message", {{"to", muster_client::null}}, "here");
//   }
//
// next() sends what was given and waits for the next tick; it is false when the run is over.
// docs/reference/bridge_format.md defines the format.
#pragma once

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace muster_client {

struct BridgeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

constexpr double null = std::numeric_limits<double>::quiet_NaN();  // an empty cell

struct Column {
  std::string name, unit, reference;  // reference: the set whose rows it numbers
  bool nullable = false, infinite = false, bytes = false;
};

struct Table {
  std::string name, set;  // set: that of a table of all rows; else ""
  std::vector<Column> columns;
  bool is_command = false, is_queue = false;

  std::size_t column(std::string_view name_) const {
    for (std::size_t c = 0; c < columns.size(); ++c) {
      if (columns[c].name == name_) return c;
    }
    throw BridgeError(name + " has no column " + std::string(name_));
  }
};

using Names = std::map<std::string, std::vector<std::string>>;  // of rows, by set

// A row of a table, valid until the next tick.
class Row {
 public:
  Row(const Table& table, const Names& names, const double* cells, const std::string* bytes)
      : table_(&table), names_(&names), cells_(cells), bytes_(bytes) {}
  double operator[](std::size_t column) const { return cells_[column]; }
  double operator[](const char* column) const { return cells_[table_->column(column)]; }
  bool is_null(const char* column) const { return (*this)[column] != (*this)[column]; }
  // Of a column that refers to rows of a set: the row's name.
  const std::string& name(const char* column) const {
    const std::size_t c = table_->column(column);
    return names_->at(table_->columns[c].reference).at(static_cast<std::size_t>(cells_[c]));
  }
  const std::string& bytes(const char* column) const {
    std::size_t at = 0;
    for (std::size_t c = 0; c < table_->column(column); ++c) at += table_->columns[c].bytes;
    return bytes_[at];
  }

 private:
  const Table* table_;
  const Names* names_;
  const double* cells_;
  const std::string* bytes_;
};

namespace detail {

enum Kind : uint8_t { join = 1, tables, rows, state, commands, bye, fault };

class Writer {
 public:
  template <class Integer>
  Writer& integer(Integer value) {
    for (std::size_t i = 0; i < sizeof value; ++i) bytes_ += static_cast<char>((value >> (8 * i)) & 0xff);
    return *this;
  }
  Writer& real(double value) {
    uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return integer(bits);
  }
  Writer& raw(std::string_view bytes) { return bytes_ += bytes, *this; }
  Writer& text(std::string_view text) { return integer(static_cast<uint32_t>(text.size())).raw(text); }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

class Reader {
 public:
  explicit Reader(std::string bytes) : bytes_(std::move(bytes)) {}
  template <class Integer>
  Integer integer() {
    const std::string_view bytes = raw(sizeof(Integer));
    uint64_t value = 0;
    for (std::size_t i = 0; i < sizeof(Integer); ++i) value |= uint64_t{static_cast<uint8_t>(bytes[i])} << (8 * i);
    return static_cast<Integer>(value);
  }
  double real() {
    const auto bits = integer<uint64_t>();
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  std::string text() { return std::string(raw(integer<uint32_t>())); }

 private:
  std::string_view raw(std::size_t count) {
    if (count > bytes_.size() - at_) throw BridgeError("a frame of the run ends too early");
    at_ += count;
    return std::string_view(bytes_).substr(at_ - count, count);
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

}  // namespace detail

class Client {
 public:
  // Takes over a connected socket.
  explicit Client(int connection) : connection_(connection) {
    send_frame(detail::Writer().integer<uint8_t>(detail::join).raw("MUSTERB1").bytes());
    detail::Reader reader = receive();
    if (kind_ != detail::tables) throw BridgeError("what is there is no bridge of muster");
    dt_ = reader.real();
    for (auto sets = reader.integer<uint32_t>(); sets > 0; --sets) {
      const std::string set = reader.text();
      for (auto rows = reader.integer<uint32_t>(); rows > 0; --rows) names_[set].push_back(reader.text());
    }
    for (auto tables = reader.integer<uint32_t>(); tables > 0; --tables) read_table(reader);
  }
  Client(Client&& other) noexcept { swap(other); }
  Client& operator=(Client&& other) noexcept { return swap(other), *this; }
  ~Client() {
    if (connection_ < 0) return;
    const std::string frame = framed(detail::Writer().integer<uint8_t>(detail::bye).text("the client leaves").bytes());
    if (::send(connection_, frame.data(), frame.size(), MSG_NOSIGNAL) < 0) {
      // The run has gone first.
    }
    ::close(connection_);
  }

  bool next() {
    if (began_) send_commands();
    began_ = true;
    while (true) {
      detail::Reader reader = receive();
      if (kind_ == detail::state) return read_state(reader), true;
      if (kind_ == detail::rows) {
        auto& names = names_[reader.text()];
        names.resize(reader.integer<uint32_t>());
        for (auto more = reader.integer<uint32_t>(); more > 0; --more) names.push_back(reader.text());
      } else if (kind_ == detail::bye) {
        return end_ = reader.text(), false;
      } else if (kind_ == detail::fault) {
        throw BridgeError(reader.text());
      } else {
        throw BridgeError("a frame of kind " + std::to_string(kind_) + ", which this client does not know");
      }
    }
  }

  uint64_t tick() const { return tick_; }
  double time() const { return time_; }  // [s]
  double dt() const { return dt_; }      // [s]
  const std::string& end() const { return end_; }
  const std::vector<std::string>& names(const std::string& set) const { return names_.at(set); }

  Row row(const std::string& table) const { return rows(table).at(0); }
  std::vector<Row> rows(const std::string& name) const {
    const std::size_t t = find(name, false);
    const Table& table = tables_[t];
    const std::size_t width = table.columns.size(), blobs = byte_columns(table);
    std::vector<Row> result;
    for (std::size_t r = 0; r * width < cells_[t].size(); ++r)
      result.emplace_back(table, names_, cells_[t].data() + r * width, bytes_[t].data() + r * blobs);
    return result;
  }

  // Every cell of a table of commands, row by row.
  void set(const std::string& table, std::vector<double> cells) {
    const std::size_t t = find(table, true);
    if (tables_[t].is_queue || cells.empty() || cells.size() % tables_[t].columns.size() != 0)
      throw BridgeError(table + ": " + std::to_string(cells.size()) + " numbers; expected " +
                        (tables_[t].is_queue ? "send()" : std::to_string(tables_[t].columns.size()) + " a row"));
    cells_[t] = std::move(cells);
    is_given_[t] = true;
  }
  // Appends a message to a queue; columns that are not given are empty.
  void send(const std::string& table, std::initializer_list<std::pair<const char*, double>> columns,
            std::string payload) {
    const std::size_t t = find(table, true);
    std::vector<double> row(tables_[t].columns.size(), null);
    if (!tables_[t].is_queue || byte_columns(tables_[t]) != 1) throw BridgeError(table + " is no queue of messages");
    for (const auto& [column, value] : columns) row[tables_[t].column(column)] = value;
    cells_[t].insert(cells_[t].end(), row.begin(), row.end());
    bytes_[t].push_back(std::move(payload));
  }

 private:
  void swap(Client& other) noexcept {
    std::swap(connection_, other.connection_);
    std::swap(tables_, other.tables_);
    std::swap(names_, other.names_);
    std::swap(cells_, other.cells_);
    std::swap(bytes_, other.bytes_);
    std::swap(is_given_, other.is_given_);
    std::swap(tick_, other.tick_);
    std::swap(time_, other.time_);
    std::swap(dt_, other.dt_);
    std::swap(end_, other.end_);
    std::swap(began_, other.began_);
    std::swap(kind_, other.kind_);
  }

  static std::size_t byte_columns(const Table& table) {
    std::size_t count = 0;
    for (const auto& column : table.columns) count += column.bytes;
    return count;
  }

  std::size_t find(const std::string& name, bool is_command) const {
    std::string known;
    for (std::size_t t = 0; t < tables_.size(); ++t) {
      if (tables_[t].is_command != is_command) continue;
      if (tables_[t].name == name) return t;
      known += (known.empty() ? "" : ", ") + tables_[t].name;
    }
    throw BridgeError(std::string("the bridge ") + (is_command ? "writes" : "reads") + " no table " + name +
                      "; expected one of " + known);
  }

  void read_table(detail::Reader& reader) {
    Table table;
    table.is_command = reader.integer<uint8_t>();
    table.is_queue = reader.integer<uint8_t>();
    table.name = reader.text();
    table.set = reader.text();
    for (auto columns = reader.integer<uint32_t>(); columns > 0; --columns) {
      Column column;
      column.name = reader.text();
      column.unit = reader.text();
      column.reference = reader.text();
      const auto flags = reader.integer<uint8_t>();
      column.nullable = flags & 1;
      column.infinite = flags & 2;
      column.bytes = flags & 4;
      table.columns.push_back(std::move(column));
    }
    tables_.push_back(std::move(table));
    cells_.emplace_back();
    bytes_.emplace_back();
    is_given_.push_back(false);
  }

  void read_state(detail::Reader& reader) {
    tick_ = reader.integer<uint64_t>();
    time_ = reader.real();
    for (std::size_t t = 0; t < tables_.size(); ++t) {
      cells_[t].clear();
      bytes_[t].clear();
      is_given_[t] = false;
      if (tables_[t].is_command) continue;
      const auto rows = reader.integer<uint32_t>();
      cells_[t].resize(rows * tables_[t].columns.size());
      for (double& cell : cells_[t]) cell = reader.real();
      for (std::size_t i = 0; i < rows * byte_columns(tables_[t]); ++i) bytes_[t].push_back(reader.text());
    }
  }

  void send_commands() {
    detail::Writer frame;
    frame.integer<uint8_t>(detail::commands).integer(tick_);
    for (std::size_t t = 0; t < tables_.size(); ++t) {
      if (!tables_[t].is_command) continue;
      if (!is_given_[t] && !tables_[t].is_queue)
        throw BridgeError("nothing was given for " + tables_[t].name + " at tick " + std::to_string(tick_) +
                          "; expected set()");
      frame.integer(static_cast<uint32_t>(cells_[t].size() / tables_[t].columns.size()));
      for (const double cell : cells_[t]) frame.real(cell);
      for (const auto& bytes : bytes_[t]) frame.text(bytes);
    }
    try {
      send_frame(frame.bytes());
    } catch (const BridgeError&) {
      // The run has ended meanwhile; its last words may still be there.
    }
  }

  static std::string framed(const std::string& body) {
    return detail::Writer().text(body).bytes();  // a frame is a text: its length, then what it says
  }

  void send_frame(const std::string& body) {
    const std::string frame = framed(body);
    for (std::size_t at = 0; at < frame.size();) {
      const auto sent = ::send(connection_, frame.data() + at, frame.size() - at, MSG_NOSIGNAL);
      if (sent < 0 && errno == EINTR) continue;
      if (sent <= 0) throw BridgeError("the run has gone");
      at += static_cast<std::size_t>(sent);
    }
  }

  std::string exactly(std::size_t count) {
    std::string result(count, '\0');
    for (std::size_t at = 0; at < count;) {
      const auto got = ::recv(connection_, &result[at], count - at, 0);
      if (got < 0 && errno == EINTR) continue;
      if (got <= 0) throw BridgeError("the run has gone");
      at += static_cast<std::size_t>(got);
    }
    return result;
  }

  detail::Reader receive() {
    detail::Reader reader(exactly(detail::Reader(exactly(4)).integer<uint32_t>()));
    kind_ = reader.integer<uint8_t>();
    return reader;
  }

  int connection_ = -1;
  std::vector<Table> tables_;
  Names names_;
  std::vector<std::vector<double>> cells_;  // of each table
  std::vector<std::vector<std::string>> bytes_;
  std::vector<bool> is_given_;
  uint64_t tick_ = 0;
  double time_ = 0, dt_ = 0;
  std::string end_;  // why the run ended
  bool began_ = false;
  uint8_t kind_ = 0;
};

namespace detail {
template <class Address>
Client connected(int family, const Address& address, const std::string& place, double wait) {
  using Clock = std::chrono::steady_clock;
  const auto until = Clock::now() + std::chrono::duration<double>(wait);
  while (true) {
    const int connection = ::socket(family, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (::connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      const int on = 1;
      if (family == AF_INET) ::setsockopt(connection, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
      return Client(connection);
    }
    const std::string why = std::strerror(errno);
    ::close(connection);
    if (Clock::now() >= until) throw BridgeError("no run listens at " + place + ": " + why);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}
}  // namespace detail

// The run that listens at 127.0.0.1:port; tries for `wait` seconds.
inline Client connect(uint16_t port = 47474, double wait = 30) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return detail::connected(AF_INET, address, "127.0.0.1:" + std::to_string(port), wait);
}

// The run that listens at a Unix socket.
inline Client connect(const std::string& path, double wait = 30) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) throw BridgeError(path + " is too long for a Unix socket");
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return detail::connected(AF_UNIX, address, path, wait);
}

}  // namespace muster_client
