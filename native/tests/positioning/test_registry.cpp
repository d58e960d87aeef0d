#include <gmock/gmock.h>

#include <set>

#include "mpm/positioning/registry.h"
#include "thesis.h"

namespace mpm {
namespace {

TEST(Registry, EveryMethodIsMadeByItsName) {
  const SurfaceModel model = testing::inclined_plane(0);
  std::set<std::string> names;
  for (const MethodInfo& m : methods()) {
    EXPECT_TRUE(names.insert(m.name).second) << m.name << " twice";
    EXPECT_THAT(m.guarantee, ::testing::AnyOf(::testing::StrEq("proven"), ::testing::StrEq("sampled")));
    EXPECT_NE(make_method(m.name, model, testing::thesis_tool(), {}), nullptr);
  }
  EXPECT_THAT(names, ::testing::IsSupersetOf({"exact", "vcrf", "drd", "dtm", "dstm", "pam"}));
}

// What the table says of spins is what the methods do.
TEST(Registry, SaysWhichMethodsSpin) {
  const SurfaceModel model = testing::inclined_plane(0);
  Counters counters;
  for (const MethodInfo& m : methods()) {
    const auto method = make_method(m.name, model, testing::thesis_tool(), {});
    if (m.spins)
      EXPECT_NO_THROW(method->drop(Vec2(50, 50), counters)) << m.name;
    else
      EXPECT_THROW(method->drop(Vec2(50, 50), counters), std::invalid_argument) << m.name;
  }
}

TEST(Registry, AnUnknownNameIsAnsweredWithTheKnown) {
  const SurfaceModel model = testing::inclined_plane(0);
  try {
    make_method("exakt", model, testing::thesis_tool(), {});
    FAIL();
  } catch (const std::invalid_argument& wrong) {
    EXPECT_THAT(wrong.what(), ::testing::HasSubstr("'exakt'"));
    for (const MethodInfo& m : methods()) EXPECT_THAT(wrong.what(), ::testing::HasSubstr(m.name));
  }
}

TEST(Registry, OptionsOfOneMethodAreNotThoseOfAnother) {
  const SurfaceModel model = testing::inclined_plane(0);
  MethodOptions options;
  options.numbers["gouge_mm"] = 0.01;
  EXPECT_NO_THROW(make_method("exact", model, testing::thesis_tool(), options));
  EXPECT_THROW(make_method("vcrf", model, testing::thesis_tool(), options), std::invalid_argument);
  MethodOptions steep;
  steep.tilt_max = kPi / 2;
  EXPECT_THROW(make_method("exact", model, testing::thesis_tool(), steep), std::invalid_argument);
}

}  // namespace
}  // namespace mpm
