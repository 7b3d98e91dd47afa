#include "benchmarks/table/cell.hpp"

#include <algorithm>
#include <cmath>

#include "benchmarks/base/number_format.hpp"
#include "benchmarks/base/words.hpp"

namespace hullbench::table {
namespace {

std::string mark(std::size_t note) {
  return "[" + std::to_string(note) + "]";
}

}  // namespace

Number::Number(double of_value) : value(of_value), decimals(decimals_of(of_value)) {}

std::string Number::text() const {
  if (std::isinf(value)) return value < 0 ? "-∞" : "∞";
  return (has_plus && value >= 0 ? "+" : "") + fixed(value, decimals);
}

std::string Range::text() const {
  if (std::isinf(low.value)) return low.text();
  if (std::isinf(high.value)) return "> " + low.text();
  return low.text() + (low.has_plus ? " to " : "–") + high.text();
}

std::string Cell::text() const {
  std::string result = value ? value->text() : words;
  if (spread) result += " ±" + spread->text();
  if (other) result += " (" + other->text() + ")";
  if (of) result += " of " + of->text();
  if (range) result += value ? " (" + range->low.text() + " to " + range->high.text() + ")" : range->text();
  if (!sign.empty()) result += " " + sign;
  return result;
}

std::string Cell::marks() const {
  return joined(notes, " ", mark);
}

std::size_t Notes::number(const std::string& text) {
  auto found = std::ranges::find(texts_, text);
  if (found == texts_.end()) found = texts_.insert(texts_.end(), text);
  return static_cast<std::size_t>(found - texts_.begin()) + 1;
}

std::vector<std::string> Notes::marked() const {
  std::vector<std::string> result;
  for (const std::string& text : texts_) result.push_back(mark(result.size() + 1) + " " + text);
  return result;
}

}  // namespace hullbench::table
