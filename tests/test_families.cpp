#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

#include "benchmarks/base/names.hpp"
#include "datasets/families.hpp"
#include "datasets/holes.hpp"
#include "datasets/point_bytes.hpp"
#include "datasets/sha256.hpp"
#include "tests/boost_checks.hpp"

namespace hullbench::testing {
namespace {

// Of a centre and a distance worked out from coordinates up to 200, rounded to 2.8e-14.
constexpr double kFamilyRounding = 1e-12;

/// SHA-256 of the points of all rings of shapes 0 .. count - 1 of `family`, one after another.
std::string digest(const ShapeFamily& family, std::size_t count, bool holes) {
  std::string bytes;
  for (std::size_t index = 0; index < count; ++index) {
    for (const Ring& ring : rings_of(family_shape(family, index, holes))) bytes += point_bytes(ring);
  }
  return sha256_hex(bytes);
}

const ShapeFamily& family_named(std::string_view name) {
  const auto& families = shape_families();
  const auto found =
      std::ranges::find_if(families, [&](const ShapeFamily& family) { return family.name == name; });
  if (found == families.end()) throw std::invalid_argument(std::string(name));
  return *found;
}

TEST(ShapeFamilies, AreCompleteAndNamedOnce) {
  std::set<std::string> names;
  std::size_t shapes = 0;
  for (const ShapeFamily& family : shape_families()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_FALSE(family.title.empty()) << family.name;
    EXPECT_FALSE(family.source.empty()) << family.name;
    EXPECT_FALSE(family.licence.empty()) << family.name;
    EXPECT_EQ(family.holes.has_value(), family.name == "star") << family.name;
    EXPECT_NO_THROW(family.make(family.count - 1)) << family.name;
    EXPECT_THROW(family.make(family.count), std::invalid_argument) << family.name;
    shapes += family.count;
  }
  EXPECT_EQ(names, (std::set<std::string>{"star",   "comb",    "spiral",  "partition", "walk",    "nested",
                                          "parts",  "country", "county",  "clipart",   "fashion", "han",
                                          "symbol", "pierced", "annulus", "windows",   "channel", "peninsula",
                                          "teeth",  "squares", "discs",   "strips",    "cell"}));
  EXPECT_EQ(shapes, 11'228U);
}

TEST(ShapeFamilies, AreTheSameEverywhere) {
  // Digests of what this code gave when it was written: a change of any bit of any shape shows here, and
  // makes results incomparable with those recorded before.
  const std::map<std::string, std::string> expected{
      {"star", "e1db020c9df19736c380e1dc94935689c9f1dbf516e60167ebb1a67b610cd382"},
      {"comb", "8441c5a79fe1fec61dd9ea49c353518e52f0f2723702c83c9e36aa775cc4e3cb"},
      {"spiral", "a169066fbdfff6b69246ca238ff7a267bec83659ec572468fbd7284311cfd5ec"},
      {"partition", "f19d623f0c6b8cdd308a185455740370953cf3f5a1e73e9f0a3fbc88828a855a"},
      {"walk", "b89409fe4c319d8a3a4f1f1e6df769d748d6ce77875c6a934c64d75500362fbf"},
      {"nested", "5e43253cf5767d7ec7f5535f79de4641ffdf5d6ad46a80eb9469cb9fb668f781"},
      {"parts", "3dbc59d0b32f99986144e7571e6f0c6276f540beb6b7e1d54e7fdb33a65e6b52"},
      {"country", "c26fdd962e7eaa9dbfbf16ff2d9cb275b989755207a32367e282d41ccbb87b27"},
      {"county", "1c01a8eed7913fec5d63f3bd909bb29bad35c981d661207e51ea7c92dc4d87a4"},
      {"clipart", "6290d3c108ca418d36fa14479fc1e6e9d4cc57d5120405d862d5211540eeec9f"},
      {"fashion", "98a817dcadb0bc4419b401b2ed5ed7acfd8a53edcb5e4dea3f5457ab0f5e9f04"},
      {"han", "fed64060fe972362e642d3605c4182db46f3547af9ba6e6a8c5db25f5ee81737"},
      {"symbol", "cc8f3043d2bde61eb9b3d7bdb7b144a8439e08000da7016ccf773672f9c00b97"},
      {"pierced", "062e0a06792832714ce0ef1c95cf0f96cbf2931595a8228505fbc5bf2ca556cf"},
      {"annulus", "e56e57e5397df6ee22cd8c2ec12a959e2e45b9cdd07f807a9269988c7e88f616"},
      {"windows", "e550018664c6feac0c9b025dd1eadb5bd5e98aff5731a0f14ba447c17b7afdba"},
      {"channel", "1d552e66fb5b5284ecbc14e04a2d2b631c4371cf065836b59e3edacbd71483cc"},
      {"peninsula", "60a4a3cf0656be3669e4bc6a631738fa96e24cdfc285297cc29c4847dbe81a3c"},
      {"teeth", "27337e473c5e6aeba2f7f51847635ebba4a1ae288ae01ee5d95b459b0ac46de3"},
      {"squares", "92d041e3135e0eb6b02b9e9c98160dc201ab6731bb6864902420e3c4c81d7eb6"},
      {"discs", "aca8d633e5bb0216b7fbd87b2f655922109895dd3b49d1e71ab3231888ed1150"},
      {"cell", "734caee59441cc702e901fb1aab7cfe04a3f71a02ffa30903d31562a39c61482"},
      {"strips", "0548d95cfacf74049b2a02b6254bc696bc46ac84f0edcdd6b3f62c1d188ac724"},
  };
  for (const ShapeFamily& family : shape_families()) {
    EXPECT_EQ(digest(family, family.count, false), expected.at(family.name)) << family.name;
  }
  EXPECT_EQ(digest(family_named("star"), 980, true),
            "a25760041bf5e4a63adeaeaa77e94d1a3407d34f6d8f10bae7e8c3ab1de99123");
}

TEST(FamilyShape, WithoutHolesIsWhatTheFamilyMakes) {
  for (const ShapeFamily& family : shape_families()) {
    EXPECT_EQ(family_shape(family, 3, false), family.make(3)) << family.name;
  }
}

TEST(FamilyShape, HolesAskedOfAFamilyWithoutAreAnError) {
  EXPECT_THROW(family_shape(family_named("comb"), 0, true), std::invalid_argument);
}

TEST(FamilyShape, EveryStarPolygonHasRoomForItsHoles) {
  const ShapeFamily& star = family_named("star");
  for (std::size_t index = 0; index < star.count; ++index) {
    const MultiPolygon shape = family_shape(star, index, true);
    ASSERT_EQ(shape.size(), 1U) << index;
    ASSERT_EQ(shape.front().holes.size(), 5U) << index;
  }
}

TEST(FamilyShape, HolesKeepClearOfEveryBoundary) {
  const ShapeFamily& star = family_named("star");
  for (std::size_t index = 0; index < star.count; index += 10) {
    const MultiPolygon shape = family_shape(star, index, true);
    EXPECT_EQ(shape.front().shell, star.make(index).front().shell) << index;
    EXPECT_EQ(boost_fault(shape), "") << index;
    for (const Ring& hole : shape.front().holes) {
      const Point centre{(hole[0].x + hole[kHoleCorners / 2].x) / 2,
                         (hole[0].y + hole[kHoleCorners / 2].y) / 2};
      EXPECT_NEAR(std::hypot(hole[0].x - centre.x, hole[0].y - centre.y), 7.5, kFamilyRounding) << index;
      EXPECT_GE(boost_distance(centre, shape.front().shell), 15 - kFamilyRounding) << index;
      for (const Ring& other : shape.front().holes) {
        if (other == hole) continue;
        EXPECT_GE(boost_distance(centre, other), 15 - kFamilyRounding) << index;
      }
    }
  }
}

}  // namespace
}  // namespace hullbench::testing
