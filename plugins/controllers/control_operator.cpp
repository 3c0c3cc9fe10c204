// A person at a station: orders that go by the radio, are lost like all else, and are given again until they are
// answered.
#include <cmath>
#include <muster/plugin.hpp>

#include "mission_doubts.hpp"
#include "mission_elements.hpp"

namespace {

using namespace muster;
using namespace muster::missions;

struct Order {
  double at, to, again, tries;  // again 0: given once
  std::string text;
};

std::vector<Order> read_orders(const Setup& setup) {
  const XmlElement root = read_file(setup, "orders");
  if (root.name != "orders") refuse(root.place, "the root element is <" + root.name + ">; expected <orders>");
  expect_attributes(root, {});
  std::vector<Order> orders;
  for (const auto& each : root.children) {
    if (each.name != "order") refuse(each.place, "<" + each.name + "> is no element of <orders>; expected <order>");
    expect_attributes(each, {"at", "to", "text", "again", "tries"});
    const auto* to = each.attribute("to");
    if (to && radio_row(setup, to->value, to->value_place) == setup.param("radio"))
      refuse(to->value_place, "attribute \"to\": " + quote(to->value) + " speaks to itself; expected another radio");
    Order order{number(needed(each, "at", "a time in seconds"), 0, 1e9, "s"),
                to ? radio_row(setup, to->value, to->value_place) : -1, number(each, "again", 0, 1e-3, 1e9),
                number(each, "tries", 1e9, 1, 1e9), needed(each, "text", "what is said").value};
    if (order.again > 0 && order.to < 0)
      refuse(each.place, "<order> to all is answered by nobody in particular; again=\"...\" needs to=\"...\"");
    if (order.again == 0 && each.attribute("tries"))
      refuse(each.attribute("tries")->place, "tries=\"...\" needs again=\"...\", the time between them");
    if (order.tries != std::floor(order.tries))
      refuse(each.attribute("tries")->value_place,
             "attribute \"tries\": " + print_real(order.tries) + " is no whole number; expected one, such as 3");
    orders.push_back(std::move(order));
  }
  if (orders.empty()) refuse(root.place, "<orders> is empty; expected <order at=\"...\" to=\"...\" text=\"...\"/>");
  return orders;
}

struct ControlOperator {
  static constexpr auto id = "control.operator/2";
  static constexpr auto summary = "gives a list of orders by a station's radio";
  static constexpr auto manual =
      "`orders` is an XML file in the world's folder: <order at=\"5\" to=\"scout\" text=\"go\" again=\"2\"\n"
      "tries=\"10\"/>, at 5 s and then every 2 s until the scout has answered \"ok go\", at most ten times\n"
      "(docs/reference/mission_file.md). Without `to` an order goes to all. Orders and answers are messages as any\n"
      "other.";
  static constexpr auto phase = MUSTER_CONTROL;
  static constexpr Param params[] = {reference("radio", "radio", "the station's radio").required(),
                                     text("orders", "", "an XML file").required()};

  struct State {
    static constexpr const char* columns = "given answered unanswered mark progress{}";
    double given, answered, unanswered;  // messages sent; orders that were answered, that were given up
    double mark, progress;               // of the file; how far each of its orders is
  };
  static constexpr unsigned progress_column = 4;
  struct Progress {
    double sent = 0, last = 0, done = 0;  // times it was said, when last; 1 when there is no more to do
  };

  explicit ControlOperator(Setup& s)
      : orders(read_orders(s)),
        mark(mark_of(read_file(s, "orders"))),
        radio(s.param("radio")),
        inbox(s.read<Incoming>("inbox/{radio}/message")),
        outbox(s.write<Outgoing>("outbox/{radio}/message")),
        state(s.write<State>("self/state")) {
    for (const std::string& doubt : doubts_of_orders(s, read_file(s, "orders")))
      s.host()->event(s.host(), ("warning: " + doubt).c_str());
  }

  void step(const Step& k) const {
    State now = *k.last(state);
    std::vector<Progress> all(orders.size());
    const auto bytes = k.last_bytes(state, 0, progress_column);
    // Progress in other orders, before a swap, means nothing in these.
    if (now.mark == mark && bytes.size() == all.size() * sizeof(Progress))
      std::memcpy(all.data(), bytes.data(), bytes.size());
    now.mark = mark;
    listen(k, now, all);
    std::size_t sent = 0;
    for (std::size_t i = 0; i < orders.size(); ++i) {
      if (all[i].done != 0 || !is_to_give(k, orders[i], all[i])) continue;
      if (all[i].sent >= orders[i].tries) {
        k.event("the order \"" + orders[i].text + "\" was never answered by " + receiver(k, orders[i]));
        ++now.unanswered, all[i].done = 1;
        continue;
      }
      k.send(outbox, sent++, orders[i].text) = {radio, orders[i].to < 0 ? null() : orders[i].to, 0};
      ++now.given, ++all[i].sent, all[i].last = k.time();
      all[i].done = orders[i].again == 0;
    }
    k.put_bytes(state, 0, progress_column, {reinterpret_cast<const char*>(all.data()), all.size() * sizeof(Progress)});
    now.progress = k[state]->progress;
    *k[state] = now;
  }

  // At the first tick from its time on, and then again and again.
  static bool is_to_give(const Step& k, const Order& order, const Progress& so_far) {
    const double due = so_far.sent == 0 ? order.at : so_far.last + order.again;
    return k.time() >= due - k.dt() / 2;
  }

  static std::string receiver(const Step& k, const Order& order) {
    return std::string(k.name("radio", static_cast<std::size_t>(order.to)));
  }

  void listen(const Step& k, State& now, std::vector<Progress>& all) const {
    for (std::size_t m = 0; m < k[inbox].size(); ++m) {
      const auto words = k.bytes(inbox, m, Incoming::payload_column);
      for (std::size_t i = 0; i < orders.size(); ++i) {
        const bool is_answer =
            all[i].sent > 0 && all[i].done == 0 && k[inbox][m].from == orders[i].to && words == "ok " + orders[i].text;
        if (!is_answer) continue;
        all[i].done = 1, ++now.answered;
        k.event("the order \"" + orders[i].text + "\" is answered by " + receiver(k, orders[i]));
        break;  // the first of two orders that are alike
      }
    }
  }

  std::vector<Order> orders;
  double mark;  // of the file
  double radio;
  In<Incoming> inbox;
  Out<Outgoing> outbox;
  Out<State> state;
};

}  // namespace

MUSTER_PLUGIN_IS(ControlOperator)
