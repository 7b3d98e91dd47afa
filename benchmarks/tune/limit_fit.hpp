// Fits the numbers of the core's automatic limit on the training side of the split, by running the core.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/tune/limit_case.hpp"
#include "core/src/automatic_limit.hpp"

namespace hullbench::tune {

using polylidar::detail::AutomaticConstants;

/// A data set and how many points of it; the sample's seed is 1.
struct LimitCaseName {
  std::string dataset;
  bool holes = false;
  std::size_t n = 0;
};

/// "gradient:16" of "star-1~gradient:16", "uniform" of "star-1".
std::string sampling_of(const std::string& dataset);

/// The cases of the fit: two shapes of every training source, sampled in the ways that training knows, of 500
/// and 2,000 points; of the first of both also 8,000 points, and of some ways 32,000; and stars with round
/// holes.
std::vector<LimitCaseName> training_limit_cases();

/// Eighteen test shapes, sampled in every way that there is: `n` points. Then those that have a variant with
/// holes, with them.
std::vector<LimitCaseName> test_limit_cases(std::size_t n);

/// The same shapes, sampled in ways whose density varies: `n` points, so many that places can have sizes of
/// their own.
std::vector<LimitCaseName> large_limit_cases(std::size_t n);

/// A case and what it is compared with.
struct MadeLimitCase {
  LimitCaseName name;
  std::unique_ptr<LimitCase> triangles;
  double best_of_one_limit = 0;  ///< LimitCase::best_error_of_one_limit
};

/// The cases in the order of their names, made on all of `cores` (parallel.hpp). Throws as make_point_set and
/// LimitCase.
std::vector<MadeLimitCase> make_limit_cases(const std::vector<LimitCaseName>& names,
                                            const std::vector<int>& cores);

/// Case -> error of the core's default with these constants; the same on any number of cores.
std::vector<double> limit_errors(std::vector<MadeLimitCase>& cases, const AutomaticConstants& constants,
                                 const std::vector<int>& cores);

/// What the fit makes small. Of a case it is log(error / the error of the best single limit), so that hard
/// cases do not outweigh easy ones, cut to -1.5 to 1.5, so that neither one failure nor one way to sample
/// outweighs them all; then the mean over the cases of a way to sample, then over these. Uniform points count
/// 1.5, as what most users have.
double limit_score(std::vector<MadeLimitCase>& cases, const AutomaticConstants& constants,
                   const std::vector<int>& cores);

/// One of the rule's numbers, to be changed by name.
struct LimitKnob {
  const char* name = nullptr;
  double AutomaticConstants::*length = nullptr;  ///< or
  std::size_t AutomaticConstants::*count = nullptr;
  double least = 0;
  double most = 0;

  double value(const AutomaticConstants& constants) const;
  /// Sets `value`, kept between `least` and `most` and rounded to what the code has: three digits, or a whole
  /// number.
  void set(AutomaticConstants& constants, double value) const;
};

/// All of them.
const std::vector<LimitKnob>& limit_knobs();

/// Where a search began and where it ended.
struct LimitClimb {
  std::string start;
  AutomaticConstants to;
  double score_from = 0;
  double score_to = 0;
};

/// Climbs from the constants in the code and from two starts that are drawn at random: `tries` times each,
/// one or two constants are changed, and what has the better score stays. The same for the same seed.
std::vector<LimitClimb> fit_limit(std::vector<MadeLimitCase>& cases, int tries, std::uint64_t seed,
                                  const std::vector<int>& cores);

/// What a search gives for a way to sample that it did not see.
struct HeldOutWay {
  std::string sampling;
  double score_of_code = 0;   ///< of its cases, with the constants in the code
  double score_of_found = 0;  ///< with those that a climb from there found on all other ways
};

/// Leaves each way to sample out in turn. A search that fits what is special to the ways it sees does worse
/// than the code on the others.
std::vector<HeldOutWay> cross_validate_limit(std::vector<MadeLimitCase>& cases, int tries, std::uint64_t seed,
                                             const std::vector<int>& cores);

/// The constants in the code with a part of the rule taken out, or with one of them changed.
struct LimitVariant {
  std::string name;
  AutomaticConstants constants;
};

/// The whole rule, then without one part after the other.
std::vector<LimitVariant> limit_ablations();

/// Each constant by itself times `factor`.
std::vector<LimitVariant> limit_sensitivities(double factor);

}  // namespace hullbench::tune
