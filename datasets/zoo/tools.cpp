#include "datasets/zoo/tools.hpp"

#include <string>

#include "datasets/sampling.hpp"

namespace hullbench::zoo {

using polylidar::MultiPolygon;
using polylidar::Point;

namespace {

std::uint64_t seed_of(std::string_view label) {
  return derive_seed(1, "zoo/" + std::string(label));
}

}  // namespace

Random numbers(std::string_view label) {
  return Random(seed_of(label));
}

polylidar::Ring rectangle(double left, double bottom, double width, double height) {
  return {{left, bottom}, {left + width, bottom}, {left + width, bottom + height}, {left, bottom + height}};
}

std::vector<Point> sample(const MultiPolygon& shape, std::size_t n, std::string_view label) {
  return sample_uniform(shape, n, seed_of(label));
}

Input sampled(const MultiPolygon& shape, std::size_t n, std::string_view label) {
  return {sample(shape, n, label), shape};
}

}  // namespace hullbench::zoo
