// JSON documents against JSON Schemas.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "benchmarks/base/names.hpp"

namespace valijson {
class Schema;
}

namespace hullbench {

/// What is wrong with a document.
struct SchemaFault {
  json::json_pointer place;
  std::string sentence;  ///< without the place; ends with a full stop
};

/// A JSON Schema: of 2020-12 what draft 7 has too, with "$defs".
class JsonSchema {
 public:
  /// The document that a "$ref" names; null when there is none.
  using Find = std::function<const json*(const std::string& name)>;

  /// `find` is for references to other documents. Throws std::exception when `schema` is none.
  explicit JsonSchema(const json& schema, const Find& find = nullptr);
  ~JsonSchema();
  JsonSchema(const JsonSchema&) = delete;
  JsonSchema& operator=(const JsonSchema&) = delete;

  /// Empty when `document` is valid. A value is said to be at fault where it stands, and not once more with
  /// every object round it.
  std::vector<SchemaFault> faults(const json& document) const;

 private:
  std::unique_ptr<valijson::Schema> schema_;
};

}  // namespace hullbench
