// WKB both ways: known bytes, every accepted form, every refusal, and mutated bytes by the ten thousand.
#include <gtest/gtest.h>

#include <atomic>
#include <bit>
#include <cstdlib>
#include <limits>
#include <new>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "adapters/wkb.hpp"
#include "benchmarks/base/names.hpp"
#include "tests/complaint.hpp"

// The largest single allocation since it was last set to 0: how the fuzzing test sees that no count in the
// bytes is believed.
static std::atomic<std::size_t> largest_allocation = 0;

// Not inlined: g++ would otherwise take malloc and operator delete for a mismatched pair.
[[gnu::noinline]] void* operator new(std::size_t size) {
  std::size_t seen = largest_allocation;
  while (size > seen && !largest_allocation.compare_exchange_weak(seen, size)) {
  }
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace hullbench::testing {
namespace {

using Bytes = std::vector<std::uint8_t>;

constexpr std::uint32_t kZ = 0x80000000U;
constexpr std::uint32_t kM = 0x40000000U;
constexpr std::uint32_t kSrid = 0x20000000U;

// Writes WKB by hand, in either byte order, and wrong where a test wants it wrong.
class Build {
 public:
  explicit Build(bool little_endian = true) : little_endian_(little_endian) {}

  Build& type(std::uint32_t code) {
    bytes_.push_back(little_endian_ ? 1 : 0);
    return count(code);
  }
  Build& count(std::uint32_t value) { return number(value, 4); }
  Build& doubles(std::initializer_list<double> values) {
    for (const double value : values) number(std::bit_cast<std::uint64_t>(value), 8);
    return *this;
  }
  Build& add(const Build& other) {
    bytes_.insert(bytes_.end(), other.bytes_.begin(), other.bytes_.end());
    return *this;
  }
  const Bytes& bytes() const { return bytes_; }

 private:
  Build& number(std::uint64_t value, std::size_t size) {
    for (std::size_t byte = 0; byte < size; ++byte) {
      const std::size_t place = little_endian_ ? byte : size - 1 - byte;
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * place)));
    }
    return *this;
  }

  bool little_endian_;
  Bytes bytes_;
};

Build triangle(bool little_endian = true) {
  return Build(little_endian).type(3).count(1).count(4).doubles({0, 0, 2, 0, 0, 1, 0, 0});
}

const Polygon kTriangle = {{{0, 0}, {2, 0}, {0, 1}}, {}};

MultiPolygon two_polygons() {
  const Ring square = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring hole = {{1, 1}, {1, 2}, {2, 2}, {2, 1}};
  const Ring other_hole = {{5, 5}, {5, 6}, {6, 5}};
  const Ring triangle = {{20, 0}, {30.5, -1e-300}, {20, 1e300}};
  return {{square, {hole, other_hole}}, {triangle, {}}};
}

std::string refusal(const Bytes& bytes) {
  return complaint_of<std::invalid_argument>([&] { from_wkb(bytes); });
}

void expect_refused(const Build& build, const std::string& why) {
  expect_says(refusal(build.bytes()), why);
}

TEST(Wkb, WritesTheBytesOfTheStandard) {
  const Bytes expected = Build().type(6).count(1).add(triangle()).bytes();
  EXPECT_EQ(to_wkb({kTriangle}), expected);
  EXPECT_EQ(to_wkb({}), Build().type(6).count(0).bytes());
}

TEST(Wkb, WritesAMultiPoint) {
  const std::vector<Point> points = {{1.5, -2}, {3, 4}};
  const Bytes expected = Build()
                             .type(4)
                             .count(2)
                             .add(Build().type(1).doubles({1.5, -2}))
                             .add(Build().type(1).doubles({3, 4}))
                             .bytes();
  EXPECT_EQ(to_wkb_multipoint(points), expected);
  EXPECT_EQ(to_wkb_multipoint({}), Build().type(4).count(0).bytes());
}

TEST(Wkb, ComesBackUnchanged) {
  EXPECT_EQ(from_wkb(to_wkb(two_polygons())), two_polygons());
  EXPECT_EQ(from_wkb(to_wkb({})), MultiPolygon());
}

TEST(Wkb, ReadsEitherByteOrderAndAMixture) {
  EXPECT_EQ(from_wkb(triangle(false).bytes()), MultiPolygon{kTriangle});
  const Build mixed = Build(false).type(6).count(2).add(triangle(true)).add(triangle(false));
  EXPECT_EQ(from_wkb(mixed.bytes()), (MultiPolygon{kTriangle, kTriangle}));
}

TEST(Wkb, DropsZMAndSrid) {
  for (const std::uint32_t code : {3U | kZ, 3U | kM, 1003U, 2003U}) {
    const Build build = Build().type(code).count(1).count(4).doubles({0, 0, 9, 2, 0, 9, 0, 1, 9, 0, 0, 9});
    EXPECT_EQ(from_wkb(build.bytes()), MultiPolygon{kTriangle}) << code;
  }
  for (const std::uint32_t code : {3U | kZ | kM, 3003U}) {
    const Build build =
        Build().type(code).count(1).count(4).doubles({0, 0, 9, 8, 2, 0, 9, 8, 0, 1, 9, 8, 0, 0, 9, 8});
    EXPECT_EQ(from_wkb(build.bytes()), MultiPolygon{kTriangle}) << code;
  }
  const Build with_srid =
      Build().type(3U | kSrid).count(4326).count(1).count(4).doubles({0, 0, 2, 0, 0, 1, 0, 0});
  EXPECT_EQ(from_wkb(with_srid.bytes()), MultiPolygon{kTriangle});
}

TEST(Wkb, TurnsRings) {
  const Ring clockwise = {{0, 0}, {0, 10}, {10, 10}, {10, 0}};
  const Ring counter_clockwise_hole = {{1, 1}, {2, 1}, {2, 2}, {1, 2}};
  const MultiPolygon shape = from_wkb(to_wkb({{clockwise, {counter_clockwise_hole}}}));
  ASSERT_EQ(shape.size(), 1U);
  EXPECT_EQ(shape[0].shell, Ring(clockwise.rbegin(), clockwise.rend()));
  ASSERT_EQ(shape[0].holes.size(), 1U);
  EXPECT_EQ(shape[0].holes[0], Ring(counter_clockwise_hole.rbegin(), counter_clockwise_hole.rend()));
}

TEST(Wkb, DropsWhatHasNoArea) {
  const Build point = Build().type(1).doubles({1, 2});
  const Build empty_point = Build().type(1).doubles({std::nan(""), std::nan("")});
  const Build line = Build().type(2).count(2).doubles({0, 0, 1, 1});
  const Build points = Build().type(4).count(2).add(point).add(empty_point);
  const Build lines = Build().type(5).count(1).add(line);
  const Build no_rings = Build().type(3).count(0);
  const Build empty_ring = Build().type(3).count(1).count(0);
  for (const Build& build :
       {point, empty_point, line, points, lines, no_rings, empty_ring, Build().type(7).count(0)}) {
    EXPECT_EQ(from_wkb(build.bytes()), MultiPolygon());
  }
  const Build collection = Build()
                               .type(7)
                               .count(6)
                               .add(point)
                               .add(line)
                               .add(triangle())
                               .add(points)
                               .add(lines)
                               .add(Build().type(6).count(2).add(no_rings).add(triangle()));
  EXPECT_EQ(from_wkb(collection.bytes()), (MultiPolygon{kTriangle, kTriangle}));
}

TEST(Wkb, RefusesBytesThatAreNotWellFormed) {
  expect_refused(Build(), "cut short");
  expect_refused(Build().type(8), "unknown type");
  expect_refused(Build().type(0), "unknown type");
  expect_refused(Build().type(4003), "unknown type");
  expect_refused(Build().type(3 | 0x10000000U).count(0), "unknown type");
  expect_refused(triangle().count(0), "bytes follow");
  expect_refused(Build().type(3).count(0xFFFFFFFFU), "more than the bytes can hold");
  expect_refused(Build().type(3).count(1).count(0xFFFFFFFFU), "more than the bytes can hold");
  expect_refused(Build().type(2).count(0x10000000U), "more than the bytes can hold");
  expect_refused(Build().type(3).count(1).count(4).doubles({0, 0, 2, 0, 0, 1, 0, 0.5}), "open ring");
  expect_refused(Build().type(3).count(1).count(3).doubles({0, 0, 2, 0, 0, 0}), "at least 4");
  expect_refused(Build().type(3).count(2).count(0).count(0), "holes without a shell");
  expect_refused(Build().type(6).count(1).add(Build().type(1).doubles({1, 2})), "type 1 inside type 6");
  const double infinity = std::numeric_limits<double>::infinity();
  expect_refused(Build().type(3).count(1).count(4).doubles({0, 0, infinity, 0, 0, 1, 0, 0}), "not finite");
  Bytes wrong_order = triangle().bytes();
  wrong_order[0] = 2;
  expect_says(refusal(wrong_order), "byte order 2");
}

TEST(Wkb, RefusesEveryPrefix) {
  const Bytes whole = to_wkb(two_polygons());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_NE(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size))), kNoComplaint)
        << size;
  }
}

TEST(Wkb, RefusesBottomlessNesting) {
  const auto nested = [](int depth) {
    Build build;
    for (int level = 0; level < depth; ++level) build.type(7).count(1);
    return build.add(triangle());
  };
  EXPECT_EQ(from_wkb(nested(10).bytes()), MultiPolygon{kTriangle});
  expect_refused(nested(100'000), "nested too deeply");
}

TEST(Wkb, SurvivesRandomMutations) {
  const std::vector<Bytes> seeds = {
      to_wkb(two_polygons()),
      Build(false).type(6).count(2).add(triangle(true)).add(triangle(false)).bytes(),
      Build()
          .type(7)
          .count(2)
          .add(Build().type(4).count(1).add(Build().type(1).doubles({1, 2})))
          .add(triangle())
          .bytes(),
      to_wkb_multipoint(two_polygons()[0].shell),
  };
  std::mt19937_64 engine(20240607);
  const auto below = [&engine](std::size_t bound) { return static_cast<std::size_t>(engine() % bound); };
  int accepted = 0;
  int refused = 0;
  for (int round = 0; round < 200'000; ++round) {
    Bytes bytes = seeds[below(seeds.size())];
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) {
      const std::size_t place = below(bytes.size());
      // Whole fields as well as bytes: large counts hide in the high bytes.
      if (below(2) == 0)
        bytes[place] = static_cast<std::uint8_t>(engine());
      else
        bytes[place] = below(2) == 0 ? 0xFF : static_cast<std::uint8_t>(below(8));
    }
    if (below(4) == 0) bytes.resize(1 + below(bytes.size()));
    largest_allocation = 0;
    try {
      from_wkb(bytes);
      ++accepted;
    } catch (const std::invalid_argument&) {
      ++refused;
    }
    // 9 bytes of a polygon become a Polygon of 48, and a vector may double: 16 times the bytes, and an error
    // message.
    ASSERT_LE(largest_allocation, 16 * bytes.size() + 512) << "round " << round;
  }
  EXPECT_GT(accepted, 1000);
  EXPECT_GT(refused, 1000);
}

}  // namespace
}  // namespace hullbench::testing
