// How much a case counts where scores are taken over many: every stratum the same, in it every shape, and of
// a shape every case. So neither the source with the most shapes nor the shape with the most cases has the
// say.
//
// A stratum is a way to sample and a kind of shape: "uniform, holes", "gradient, simple".
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace hullbench::tune {

/// The kinds of shapes, in the order of the tables: "simple", "holes" (one part with holes) and "several
/// parts" (with holes or without).
const std::vector<std::string>& shape_kinds();

/// The kind of a truth with so many parts and, in all of them, so many holes.
std::string kind_of_shape(std::size_t parts, std::size_t holes);

/// The data set's way to sample, "several" where it has more than one (samplers_of in split.hpp).
std::string sampler_of(const std::string& dataset);

/// What decides a case's weight.
struct Membership {
  std::string stratum;
  std::string shape;  ///< base shape
};

/// A weight for each of the cases, which are one at least: they sum to 1.
std::vector<double> case_weights(const std::vector<Membership>& cases);

}  // namespace hullbench::tune
