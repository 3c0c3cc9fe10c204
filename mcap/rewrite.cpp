#include "rewrite.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>

#include "text/error.hpp"
#include "writer.hpp"

namespace muster::mcap {
namespace {

// Under a temporary name of its own: FILE.part may be what is read. Schemas and channels get new numbers: those that
// are not used do not appear.
class Copier : public Visitor {
 public:
  Copier(std::filesystem::path to, const Span& span, Rewritten& result)
      : to_(std::move(to)), span_(span), result_(result) {}

  void header(const Header& header) override {
    if (!writer_) writer_ = std::make_unique<Writer>(to_, header, to_.string() + ".new");
  }
  void schema(const Schema& schema) override { schemas_[schema.id].declared = schema; }
  void channel(const Channel& channel) override { channels_[channel.id].declared = channel; }
  void metadata(const Metadata& metadata) override { writer().metadata(metadata); }

  void message(const Message& message, const std::string&) override {
    const bool stands = channels_.at(message.channel).declared.metadata.count(still) > 0;
    Message copy = message;
    if (stands) copy.log_time = std::max(message.log_time, span_.first);
    if (copy.log_time < span_.first || copy.log_time >= span_.end) return;
    copy.channel = number_of(channels_.at(message.channel));
    writer().message(copy);
    if (result_.messages++ == 0) result_.first_time = result_.last_time = copy.log_time;
    result_.first_time = std::min(result_.first_time, copy.log_time);
    result_.last_time = std::max(result_.last_time, copy.log_time);
  }

  void close() { result_.bytes = writer().close(); }
  void discard() {
    if (writer_) writer_->discard();
  }

 private:
  template <class Declared>
  struct Renumbered {
    Declared declared;
    std::optional<std::uint16_t> number;
  };

  Writer& writer() {
    if (!writer_) writer_ = std::make_unique<Writer>(to_, Header{}, to_.string() + ".new");
    return *writer_;
  }

  std::uint16_t number_of(Renumbered<Channel>& channel) {
    if (channel.number) return *channel.number;
    Channel declared = channel.declared;
    if (declared.schema != 0) {
      const auto schema = schemas_.find(declared.schema);
      if (schema == schemas_.end())
        throw Malformed(0, "channel " + std::to_string(declared.id) + " has the schema " +
                               std::to_string(declared.schema) + ", which was not declared");
      if (!schema->second.number) schema->second.number = writer().schema(schema->second.declared);
      declared.schema = *schema->second.number;
    }
    channel.number = writer().channel(declared);
    return *channel.number;
  }

  std::filesystem::path to_;
  Span span_;
  Rewritten& result_;
  std::unique_ptr<Writer> writer_;
  std::map<std::uint16_t, Renumbered<Schema>> schemas_;
  std::map<std::uint16_t, Renumbered<Channel>> channels_;
};

}  // namespace

Rewritten rewrite(const std::filesystem::path& from, const std::filesystem::path& to, Damage damage, const Span& span) {
  Rewritten result;
  Copier copier(to, span, result);
  try {
    result.scan = scan(from, copier, damage);
    copier.close();
  } catch (...) {
    copier.discard();
    throw;
  }
  return result;
}

}  // namespace muster::mcap
