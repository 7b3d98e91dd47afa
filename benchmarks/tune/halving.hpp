// One value for many shapes at a bounded cost: successive halving (Jamieson and Talwalkar, Non-stochastic
// Best Arm Identification and Hyperparameter Optimization, 2016). All positions of a method's grid are tried
// on the first quarter of the training cases, the better half of them on the next quarter, and the better
// half of these on the rest. The same for every method; where holes can be switched off, each position is
// tried with them and without, and counts with the better of its two scores.
#pragma once

#include <cstddef>
#include <vector>

#include "benchmarks/tune/tuning.hpp"

namespace hullbench::tune {

/// The places of the training cases in `cases`, in the order in which the rounds take them: source by source
/// and way to sample by way to sample in turns, so that each round has all of them. Names alone decide.
std::vector<std::size_t> training_order(const std::vector<TuningCase>& cases);

/// How many of `cases` have been taken when each round is over: a quarter, half and all of them, rounded up.
/// None for no case.
std::vector<std::size_t> round_ends(std::size_t cases);

/// Of `positions`, ascending, those with the smaller half of `scores`, rounded up, ascending; of equal scores
/// the smaller position.
std::vector<double> better_half(const std::vector<double>& positions, const std::vector<double>& scores);

/// Positions of a method to evaluate on a case.
struct TrainingItem {
  std::size_t which_case = 0;
  std::size_t which_method = 0;
  std::vector<double> positions;  ///< ascending
};

/// The positions of a method with an axis in round `round` (from 0), once the earlier ones are over.
std::vector<double> positions_of_round(const MethodTuning& method, std::size_t round);

/// What has to be evaluated in round `round` likewise: of every case all methods, those without an axis too,
/// which have no positions.
std::vector<TrainingItem> items_of_round(const Tuning& tuning, std::size_t round);

/// Scores the positions that every method with an axis had in round `round`, once its items are evaluated.
void end_round(Tuning& tuning, std::size_t round);

}  // namespace hullbench::tune
