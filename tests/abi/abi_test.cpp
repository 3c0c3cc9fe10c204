// The ABI grows at its ends only: old plugins run in new kernels.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <muster/plugin.h>

#include <cstdlib>
#include <fstream>

#include "kernel/simulation.hpp"
#include "tests/folder.hpp"

// The frozen header beside today's.
namespace now {
constexpr unsigned abi = MUSTER_ABI;
constexpr unsigned long long null_bits = MUSTER_NULL_BITS;
}  // namespace now
#undef MUSTER_PLUGIN_H
#undef MUSTER_ABI
#undef MUSTER_NULL_BITS
#undef MUSTER_DECLARE_ABI
namespace v1 {
#define muster_register muster_register_v1
#include "tests/folder.hpp"
#include "v1/muster/plugin.h"
#undef muster_register
}  // namespace v1

namespace muster {
namespace {

struct Field {
  const char* name;
  std::size_t then, then_size, now, now_size;
};

// Checks the fields of a frozen struct, and that there are no others.
void expect_same(const std::vector<Field>& fields, std::size_t then_size, std::size_t now_size) {
  std::size_t end = 0;
  for (const auto& field : fields) {
    EXPECT_EQ(field.then, field.now) << field.name;
    EXPECT_EQ(field.then_size, field.now_size) << field.name;
    EXPECT_LE(field.then - end, 4u) << "a field is missing here before " << field.name;  // no more than padding
    end = field.then + field.then_size;
  }
  EXPECT_LE(then_size - end, 4u) << "a field is missing here at the end";
  EXPECT_GE(now_size, then_size);
}

void expect_number(const char* name, unsigned then, unsigned now) { EXPECT_EQ(then, now) << name; }

#define FIELD(type, field)                                                                         \
  Field {                                                                                          \
#type "." #field, offsetof(v1::type, field), sizeof(v1::type::field), offsetof(::type, field), \
        sizeof(::type::field)                                                                      \
  }
#define EXPECT_SAME(type, ...) expect_same({__VA_ARGS__}, sizeof(v1::type), sizeof(::type))

TEST(Abi, StructsGrowOnlyAtTheirEnds) {
#define F(field) FIELD(muster_in, field)
  EXPECT_SAME(muster_in, F(data), F(rows), F(cols), F(tick));
#undef F
#define F(field) FIELD(muster_out, field)
  EXPECT_SAME(muster_out, F(data), F(rows), F(cols));
#undef F
#define F(field) FIELD(muster_tick, field)
  EXPECT_SAME(muster_tick, F(size), F(flags), F(index), F(time), F(dt), F(params));
#undef F
#define F(field) FIELD(muster_param, field)
  EXPECT_SAME(muster_param, F(name), F(kind), F(flags), F(value), F(min), F(max), F(unit), F(help), F(text));
#undef F
#define F(field) FIELD(muster_host, field)
  EXPECT_SAME(muster_host, F(size), F(abi), F(kernel), F(claim), F(file), F(text), F(search_path), F(stream), F(param),
              F(rows), F(row_name), F(row_key), F(row_alive), F(append), F(get_bytes), F(put_bytes), F(join), F(leave),
              F(place), F(error), F(refuse), F(event));
#undef F
#define F(field) FIELD(muster_cause, field)
  EXPECT_SAME(muster_cause, F(size), F(kind), F(title), F(ranges_over), F(covariates), F(imitators), F(tell_apart),
              F(replaces));
#undef F
#define F(field) FIELD(muster_plugin, field)
  EXPECT_SAME(muster_plugin, F(size), F(phase), F(id), F(summary), F(manual), F(params), F(param_count), F(cannot_hold),
              F(create), F(destroy), F(step), F(cause));
#undef F
}

// Arrays of these cross the border: they cannot grow at all.
TEST(Abi, WhatStandsInArraysKeepsItsSize) {
  EXPECT_EQ(sizeof(v1::muster_in), sizeof(::muster_in));
  EXPECT_EQ(sizeof(v1::muster_out), sizeof(::muster_out));
  EXPECT_EQ(sizeof(v1::muster_param), sizeof(::muster_param));
}

TEST(Abi, NumbersKeepTheirMeaning) {
  EXPECT_EQ(MUSTER_ABI, now::abi);
  EXPECT_EQ(MUSTER_NULL_BITS, now::null_bits);
#define SAME(name) expect_number(#name, v1::name, ::name)
  SAME(MUSTER_CONTROL), SAME(MUSTER_ACTUATE), SAME(MUSTER_PHYSICS), SAME(MUSTER_RADIO), SAME(MUSTER_NETWORK),
      SAME(MUSTER_SENSE), SAME(MUSTER_OBSERVE);
  SAME(MUSTER_OK), SAME(MUSTER_FAILED), SAME(MUSTER_READ), SAME(MUSTER_WRITE), SAME(MUSTER_ADD), SAME(MUSTER_MODIFY);
  SAME(MUSTER_OPTIONAL), SAME(MUSTER_REST), SAME(MUSTER_SENSED), SAME(MUSTER_ADOPTS), SAME(MUSTER_JOINS),
      SAME(MUSTER_EXPECTED);
  SAME(MUSTER_REAL), SAME(MUSTER_INTEGER), SAME(MUSTER_FLAG), SAME(MUSTER_CHOICE), SAME(MUSTER_REFERENCE),
      SAME(MUSTER_TEXT), SAME(MUSTER_FILE);
  SAME(MUSTER_FREE), SAME(MUSTER_REQUIRED), SAME(MUSTER_LINEAR), SAME(MUSTER_LOG), SAME(MUSTER_CYCLIC),
      SAME(MUSTER_EAST), SAME(MUSTER_NORTH);
  SAME(MUSTER_TERM), SAME(MUSTER_STAGE), SAME(MUSTER_WORLD_EDIT), SAME(MUSTER_LAW), SAME(MUSTER_INSTRUMENT);
#undef SAME
}

// What later kernels know is empty; a cause is as long as it says.
TEST(Abi, APluginOfTheFrozenHeaderDeclaresNothingLater) {
  const auto library = Library::load("abi.v1", {}, {MUSTER_BUILD_DIR "/tests/abi_plugins"}, {"test"});
  const muster_plugin& plugin = library->plugins().front();
  EXPECT_EQ(plugin.draw, nullptr);
  EXPECT_EQ(plugin.law, nullptr);
  EXPECT_EQ(plugin.clip, nullptr);
  EXPECT_EQ(plugin.burst, nullptr);
  ASSERT_NE(plugin.cause, nullptr);
  EXPECT_EQ(plugin.cause->size, sizeof(v1::muster_cause));
  EXPECT_LT(plugin.cause->size, sizeof(::muster_cause));
}

TEST(Abi, APluginOfTheFrozenHeaderRuns) {
  const test::Folder folder;
  folder.write("data.csv", "robot,x[m]\na,1.5\n");
  folder.write("world.xml",
               "<world dt='0.5' until='9'>\n<robot name='a' at='0 0 0'/>\n<abi.v1 name='old' "
               "data='data.csv' robot='a'/>\n</world>\n");
  Options options;
  options.search_path = {MUSTER_BUILD_DIR "/tests/abi_plugins"};
  Simulation sim(read_world(folder.path(), standard()), standard(), options);
  for (int tick = 1; tick <= 5; ++tick) sim.step();
  const TableView own = sim.table("instance/old/state");
  EXPECT_EQ(own.at(0, 0), 2);  // parameters
  EXPECT_EQ(own.at(0, 1), 3);
  EXPECT_EQ(own.at(0, 2), 1);
  EXPECT_EQ(own.at(0, 3), 0);
  EXPECT_EQ(own.at(0, 4), 0);
  EXPECT_EQ(own.at(0, 5), 2);  // rows: one joined
  EXPECT_EQ(own.at(0, 6), 0);  // and left
  EXPECT_EQ(own.at(0, 7), static_cast<double>(key_of("a") >> 12));
  EXPECT_EQ(own.at(0, 8), static_cast<double>(combined(mixed(1), key_of("noise")) >> 12));
  EXPECT_EQ(own.at(0, 9), 4);     // messages heard
  EXPECT_EQ(own.at(0, 10), 1.5);  // of the file
  EXPECT_EQ(sim.table("robot/a/sum").at(0, 0), 3);
  EXPECT_EQ(sim.table("robot/late/sum@old.part").at(0, 0), 2.5);
  EXPECT_EQ(sim.events().back().message, "late");
  try {
    sim.step();
    ADD_FAILURE() << "no error";
  } catch (const Error& e) {
    EXPECT_EQ(e.what(), (folder / "world.xml").string() +
                            ":3:1: old (abi.v1): step failed at tick 6 (t = 3 s): and that was all");
  }
}

}  // namespace
}  // namespace muster
