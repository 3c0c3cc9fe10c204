// Serialises a medium's state: frames in the air, messages, and a record for each radio. `fields(field, record)` calls
// `field` on all members of a record.
#pragma once

#include "medium/transmit_queue.hpp"

namespace muster::medium {

template <class Record, class Fields>
void save(Writer& out, const Air& air, const TransmitQueue& post, const std::vector<Record>& records,
          const Fields& fields) {
  air.save(out);
  post.save(out);
  out.put(records.size());
  for (const Record& record : records) fields([&](const auto& value) { out.put(value); }, record);
}

template <class Record, class Fields>
void load(Reader& in, Air& air, TransmitQueue& post, std::vector<Record>& records, const Fields& fields) {
  air.load(in);
  post.load(in);
  records.resize(in.count());
  for (Record& record : records) fields([&](auto& value) { in.get(value); }, record);
}

}  // namespace muster::medium
