// The tables of an experiment on many shapes, each at one size: the paper's alphabet.
#pragma once

#include <ostream>
#include <vector>

#include "benchmarks/table_context.hpp"

namespace hullbench {

/// Whether `shapes` are all measured at the same single size and are ten or more, or of a collection that the
/// paper has a table of: then they are the rows of one table instead of having tables of their own.
bool is_collection(const std::vector<Shape>& shapes);

/// Prints mean, standard deviation (n - 1) and maximum over the shapes of error and time, a line a method,
/// with the paper's values where it has any of these shapes; then the error of every shape, a column a
/// method. Shapes on which a method failed are left out of its statistics; the line says how many are in it.
void print_collection(TableContext& context, const std::vector<Shape>& shapes, std::ostream& out);

}  // namespace hullbench
