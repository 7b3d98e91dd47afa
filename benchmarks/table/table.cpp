#include "benchmarks/table/table.hpp"

#include <stdexcept>

namespace hullbench::table {

void Table::add_row(std::vector<Cell> cells) {
  if (cells.size() != columns.size()) throw std::invalid_argument("A row has not one cell a column.");
  rows.push_back(std::move(cells));
}

}  // namespace hullbench::table
