// State as bytes, and bytes that hold less than they say.
#include "medium/bytes.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace muster::medium {
namespace {

TEST(StateBytes, ComeBack) {
  Writer out;
  out.put_all(std::vector<double>{1, 2.5}), out.put(std::uint8_t{7}), out.put_text("end");
  const std::string bytes = out.take();
  Reader in(bytes);
  std::vector<double> values;
  in.get_all(values);
  EXPECT_EQ(values, (std::vector<double>{1, 2.5}));
  EXPECT_EQ(in.get<std::uint8_t>(), 7);
  EXPECT_EQ(in.text(), "end");
  EXPECT_TRUE(in.is_at_end());
}

TEST(StateBytes, ACountOfMoreThanFollowIsRefusedBeforeAnythingIsMade) {
  for (const std::size_t count : {std::size_t{3}, std::size_t{1} << 61, SIZE_MAX}) {
    Writer out;
    out.put(count), out.put(1.0), out.put(2.0);
    const std::string bytes = out.take();
    std::vector<double> values;
    EXPECT_THROW(Reader(bytes).get_all(values), std::runtime_error) << count;
    EXPECT_TRUE(values.empty()) << count;
    EXPECT_THROW(Reader(bytes).count(8), std::runtime_error) << count;
  }
}

}  // namespace
}  // namespace muster::medium
