#include "live/foxglove.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "live/ros_value.hpp"
#include "mcap/rewrite.hpp"
#include "text/error.hpp"
#include "text/names.hpp"

namespace muster::live {
namespace {

enum class Level { info, warning, error };
enum ServerOpcode : std::uint8_t { message_data = 1, time_data, service_response };
enum ClientOpcode : std::uint8_t { client_message_data = 1, service_request };

constexpr std::uint64_t most_number = 0xffffffff;  // of a subscription, which has four bytes

std::string text_of(const Value& value) { return value.dump(-1, ' ', false, Value::error_handler_t::replace); }

void send(Client& client, const Value& value) { client.send({text_of(value)}); }

void status(Client& client, Level level, const std::string& words) {
  send(client, {{"op", "status"}, {"level", static_cast<int>(level)}, {"message", words}});
}

bool is_number(const Value& value, std::uint64_t most = most_number) {
  return value.is_number_unsigned() && value.get<std::uint64_t>() <= most;
}

// The first words of a request that a message repeats.
std::string excerpt(const Value& value) { return quote(text_of(value)); }

Value services_of(const Services* services) {
  Value list = Value::array();
  if (!services) return list;
  for (std::size_t i = 0; i < services->services().size(); ++i) {
    const Service& one = services->services()[i];
    const auto side = [&](const char* which, const std::string& schema) {
      return Value{
          {"encoding", "cdr"}, {"schemaName", one.type + which}, {"schemaEncoding", "ros2msg"}, {"schema", schema}};
    };
    list.push_back({{"id", i},
                    {"name", one.name},
                    {"type", one.type},
                    {"request", side("_Request", one.request)},
                    {"response", side("_Response", one.response)},
                    {"requestSchema", one.request},
                    {"responseSchema", one.response}});
  }
  return list;
}

}  // namespace

struct Foxglove::Request {
  Value json;
};

Foxglove::Foxglove(Run run) : run_(std::move(run)) {
  session_ = std::to_string(std::chrono::system_clock::now().time_since_epoch().count());
}
Foxglove::~Foxglove() = default;

const std::vector<std::string>& Foxglove::subprotocols() {
  static const std::vector<std::string> known{"foxglove.websocket.v1", "foxglove.sdk.v1"};
  return known;
}

// ---- What the run says ----

std::uint16_t Foxglove::schema(mcap::Schema schema) {
  const auto same = std::find_if(schemas_.begin(), schemas_.end(), [&](const mcap::Schema& known) {
    return known.name == schema.name && known.encoding == schema.encoding && known.data == schema.data;
  });
  if (same != schemas_.end()) return same->id;
  schema.id = static_cast<std::uint16_t>(schemas_.size() + 1);
  schemas_.push_back(std::move(schema));
  return schemas_.back().id;
}

std::uint16_t Foxglove::channel(mcap::Channel channel) {
  const auto known = by_topic_.find(channel.topic);
  if (known != by_topic_.end()) {
    Channel& before = channels_[known->second];
    if (before.declared.schema == channel.schema && before.declared.encoding == channel.encoding) {
      before.is_declared = true;
      return known->second;
    }
    before.is_declared = false;
    settle();
  }
  if (channels_.size() > 0xffff) throw Error(Exit::io, "clients cannot be shown more than 65536 channels");
  channel.id = static_cast<std::uint16_t>(channels_.size());
  by_topic_[channel.topic] = channel.id;
  channels_.push_back({std::move(channel)});
  Channel& made = channels_.back();
  made.is_still = made.declared.metadata.count(mcap::still) > 0;
  if (!watchers_.empty()) {
    const std::string words = advertisement({made.declared.id});
    for (auto& [client, watcher] : watchers_) client->send({words});
  }
  return made.declared.id;
}

void Foxglove::begin(std::uint64_t time) {
  time_ = time;
  ++batch_;
  for (auto& [client, watcher] : watchers_) client->send(time_frame());
}

void Foxglove::message(const mcap::Message& message) {
  Channel& channel = channels_[message.channel];
  if (!channel.is_still && channel.batch != batch_) channel.kept.clear();
  channel.batch = batch_;
  channel.kept.push_back({message.log_time, std::make_shared<const std::string>(message.data)});
  for (auto& [client, watcher] : watchers_) {
    const auto found = watcher.subscriptions.find(message.channel);
    if (found == watcher.subscriptions.end()) continue;
    client->send(message_frame(found->second, channel, channel.kept.back()));
  }
}

void Foxglove::restart() {
  for (Channel& channel : channels_) {
    channel.is_declared = false;
    channel.kept.clear();
  }
}

void Foxglove::settle() {
  Value gone = Value::array();
  for (Channel& channel : channels_) {
    if (channel.is_declared || !channel.is_there) continue;
    channel.is_there = false;
    by_topic_.erase(channel.declared.topic);
    gone.push_back(channel.declared.id);
    for (auto& [client, watcher] : watchers_) {
      const auto found = watcher.subscriptions.find(channel.declared.id);
      if (found == watcher.subscriptions.end()) continue;
      watcher.channels.erase(found->second);
      watcher.subscriptions.erase(found);
    }
  }
  if (gone.empty()) return;
  for (auto& [client, watcher] : watchers_) send(*client, {{"op", "unadvertise"}, {"channelIds", gone}});
}

std::string Foxglove::advertisement(const std::vector<std::uint16_t>& channels) const {
  Value list = Value::array();
  for (const auto number : channels) {
    const mcap::Channel& channel = channels_[number].declared;
    const mcap::Schema& schema = schemas_[channel.schema - 1u];
    list.push_back({{"id", number},
                    {"topic", channel.topic},
                    {"encoding", channel.encoding},
                    {"schemaName", schema.name},
                    {"schema", schema.data},
                    {"schemaEncoding", schema.encoding}});
  }
  return text_of({{"op", "advertise"}, {"channels", list}});
}

Frame Foxglove::time_frame() const {
  Frame frame{std::string(1, static_cast<char>(time_data)), {}, true, true};
  mcap::put(frame.head, time_);
  return frame;
}

Frame Foxglove::message_frame(std::uint32_t subscription, const Channel& channel, const Kept& kept) {
  Frame frame{std::string(1, static_cast<char>(message_data)), kept.data, true, !channel.is_still};
  mcap::put(frame.head, subscription);
  mcap::put(frame.head, kept.time);
  return frame;
}

// ---- What a client says ----

void Foxglove::opened(Client& client) {
  watchers_[&client].number = ++clients_;
  Value capabilities{"time", "parameters"};
  if (run_.services) capabilities.push_back("services");
  send(client, {{"op", "serverInfo"},
                {"name", run_.name},
                {"capabilities", capabilities},
                {"supportedEncodings", {"cdr", "json"}},
                {"metadata", run_.metadata()},
                {"sessionId", session_}});
  std::vector<std::uint16_t> there;
  for (const auto& [topic, number] : by_topic_) there.push_back(number);
  std::sort(there.begin(), there.end());
  client.send({advertisement(there)});
  if (run_.services) send(client, {{"op", "advertiseServices"}, {"services", services_of(run_.services)}});
}

void Foxglove::closed(Client& client) { watchers_.erase(&client); }

void Foxglove::caught_up(Client& client, std::uint64_t dropped) {
  status(client, Level::warning,
         std::to_string(dropped) + " messages were left out, for this client reads more slowly than the run goes");
}

void Foxglove::received(Client& client, std::string_view message, bool is_binary) {
  if (is_binary) return take_binary(client, message);
  take_text(client, message);
}

void Foxglove::take_text(Client& client, std::string_view message) {
  const Request request{parsed_json(message)};
  if (request.json.is_discarded()) return status(client, Level::error, "a text message that is no JSON");
  const auto op = request.json.is_object() ? request.json.find("op") : request.json.end();
  if (op == request.json.end() || !op->is_string())
    return status(client, Level::error, "a request without \"op\": " + excerpt(request.json));
  using Take = void (Foxglove::*)(Client&, const Request&);
  static const std::vector<std::pair<std::string, Take>> known{{"subscribe", &Foxglove::subscribe},
                                                               {"unsubscribe", &Foxglove::unsubscribe},
                                                               {"getParameters", &Foxglove::get_parameters},
                                                               {"setParameters", &Foxglove::set_parameters}};
  const auto asked = op->get<std::string>();
  std::vector<std::string> valid;
  for (const auto& [name, take] : known) {
    if (name == asked) return (this->*take)(client, request);
    valid.push_back(name);
  }
  static const std::vector<std::pair<std::string, std::string>> unsupported{
      {"advertise", "clientPublish"},
      {"unadvertise", "clientPublish"},
      {"subscribeParameterUpdates", "parametersSubscribe"},
      {"unsubscribeParameterUpdates", "parametersSubscribe"},
      {"subscribeConnectionGraph", "connectionGraph"},
      {"unsubscribeConnectionGraph", "connectionGraph"},
      {"fetchAsset", "assets"}};
  for (const auto& [name, capability] : unsupported) {
    if (name == asked)
      return status(client, Level::error, name + ": this server has not the capability \"" + capability + '"');
  }
  status(client, Level::error, "unknown op " + quote(asked) + "; " + suggest(asked, valid));
}

void Foxglove::subscribe(Client& client, const Request& request) {
  const auto list = request.json.find("subscriptions");
  if (list == request.json.end() || !list->is_array())
    return status(client, Level::error, "subscribe: expected a list \"subscriptions\"");
  Watcher& watcher = watchers_[&client];
  const auto refuse = [&](const Value& one, const std::string& why) {
    status(client, Level::error, "subscribe: " + why + ": " + excerpt(one));
  };
  for (const Value& one : *list) {
    if (!one.is_object() || !one.contains("id") || !one.contains("channelId") || !is_number(one["id"]) ||
        !is_number(one["channelId"])) {
      refuse(one, "expected numbers \"id\" and \"channelId\"");
      continue;
    }
    const auto subscription = one["id"].get<std::uint32_t>();
    const auto number = one["channelId"].get<std::uint32_t>();
    if (number >= channels_.size() || !channels_[number].is_there) {
      refuse(one, "there is no such channel");
      continue;
    }
    const auto channel = static_cast<std::uint16_t>(number);
    if (watcher.channels.count(subscription) || watcher.subscriptions.count(channel)) {
      refuse(one, watcher.channels.count(subscription) ? "the id is in use" : "the channel is subscribed to already");
      continue;
    }
    watcher.channels[subscription] = channel;
    watcher.subscriptions[channel] = subscription;
    is_watched_ = true;
    if (channels_[number].kept.empty()) continue;
    client.send(time_frame());
    for (const Kept& kept : channels_[number].kept) client.send(message_frame(subscription, channels_[number], kept));
  }
}

void Foxglove::unsubscribe(Client& client, const Request& request) {
  const auto list = request.json.find("subscriptionIds");
  if (list == request.json.end() || !list->is_array())
    return status(client, Level::error, "unsubscribe: expected a list \"subscriptionIds\"");
  Watcher& watcher = watchers_[&client];
  for (const Value& one : *list) {
    const auto found = is_number(one) ? watcher.channels.find(one.get<std::uint32_t>()) : watcher.channels.end();
    if (found == watcher.channels.end()) {
      status(client, Level::warning, "unsubscribe: there is no subscription " + text_of(one));
      continue;
    }
    watcher.subscriptions.erase(found->second);
    watcher.channels.erase(found);
  }
}

void Foxglove::get_parameters(Client& client, const Request& request) {
  const auto names = request.json.find("parameterNames");
  if (names == request.json.end() || !names->is_array())
    return status(client, Level::error, "getParameters: expected a list \"parameterNames\"");
  Value values = Value::array();
  const auto all = run_.parameters();
  std::vector<std::string> valid;
  for (const Parameter& one : all) {
    valid.push_back(one.name);
    if (!names->empty() && std::find(names->begin(), names->end(), one.name) == names->end()) continue;
    values.push_back({{"name", one.name}, {"value", one.value}, {"type", "float64"}});
  }
  for (const Value& name : *names) {
    const std::string word = name.is_string() ? name.get<std::string>() : text_of(name);
    if (std::find(valid.begin(), valid.end(), word) == valid.end())
      status(client, Level::warning, "there is no parameter " + quote(word) + "; " + suggest(word, valid));
  }
  Value answer{{"op", "parameterValues"}, {"parameters", values}};
  if (request.json.contains("id")) answer["id"] = request.json["id"];
  send(client, answer);
}

void Foxglove::set_parameters(Client& client, const Request& request) {
  const auto list = request.json.find("parameters");
  if (list == request.json.end() || !list->is_array())
    return status(client, Level::error, "setParameters: expected a list \"parameters\"");
  Request now{{{"op", "getParameters"}, {"parameterNames", Value::array()}}};
  for (const Value& one : *list) {
    if (!one.is_object() || !one.contains("name") || !one["name"].is_string() || !one.contains("value") ||
        !one["value"].is_number()) {
      status(client, Level::error,
             "setParameters: expected a \"name\" and a \"value\" that is a number: " + excerpt(one));
      continue;
    }
    now.json["parameterNames"].push_back(one["name"]);
    try {
      run_.set_parameter(one["name"].get<std::string>(), one["value"].get<double>());
    } catch (const Error& error) {
      status(client, Level::error, error.what());
    }
  }
  if (request.json.contains("id")) now.json["id"] = request.json["id"];
  if (!now.json["parameterNames"].empty()) get_parameters(client, now);
}

void Foxglove::take_binary(Client& client, std::string_view message) {
  if (message.empty()) return status(client, Level::error, "a binary message without a byte");
  switch (static_cast<std::uint8_t>(message[0])) {
    case client_message_data:
      return status(client, Level::error, "message data: this server has not the capability \"clientPublish\"");
    case service_request:
      return call_service(client, message.substr(1));
    default:
      status(client, Level::error,
             "unknown opcode " + std::to_string(static_cast<std::uint8_t>(message[0])) + " of a binary message");
  }
}

void Foxglove::call_service(Client& client, std::string_view request) {
  std::uint32_t service, call;
  std::string encoding;
  std::string_view payload;
  try {
    mcap::Cursor from(request);
    service = from.number("the service");
    call = from.number("the call");
    encoding = std::string(from.text("the encoding"));
    payload = from.bytes(from.left(), "the payload");
  } catch (const mcap::Malformed& fault) {
    return status(client, Level::error, std::string("a call of a service: ") + fault.what());
  }
  const auto answer = [this, service, call, encoding, to = &client,
                       number = watchers_[&client].number](const ServiceAnswer& given) {
    const auto still = watchers_.find(to);
    if (still == watchers_.end() || still->second.number != number) return;  // it has gone
    if (!given.fault.empty())
      return send(*to,
                  {{"op", "serviceCallFailure"}, {"serviceId", service}, {"callId", call}, {"message", given.fault}});
    Frame frame{std::string(1, static_cast<char>(service_response)), {}, true, false};
    mcap::put(frame.head, service);
    mcap::put(frame.head, call);
    mcap::put(frame.head, std::string_view(encoding));
    frame.head += given.payload;
    to->send(std::move(frame));
  };
  if (!run_.services || service >= run_.services->services().size())
    return answer({"", "there is no service " + std::to_string(service)});
  run_.services->call(service, encoding, payload, answer);
}

}  // namespace muster::live
