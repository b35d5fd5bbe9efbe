#include "fabric/lobe_values.h"

#include <fmt/format.h>

#include <cmath>
#include <memory>

#include "base/error.h"
#include "base/files.h"
#include "base/nearest_name.h"
#include "look/json.h"

namespace sateen {

namespace {
using Kind = JsonValue::Kind;

// Takes member `key` of a row as a unit direction; complains where it is none.
Vec3 read_direction(const JsonDocument& document, const JsonValue& row, const char* key,
                    std::vector<Diagnostic>& faults) {
  const auto fault = [&](const JsonPlace& place, const std::string& message, const std::string& help = {}) {
    faults.push_back(diagnostic_at(document, place, message, help));
    return Vec3(0, 0, 1);
  };
  const JsonValue* value = row.find(key);
  if (!value)
    return fault(row.place, fmt::format("the row has no {}, expected {{\"wi\": [x, y, z], \"wo\": [x, y, z]}}", key));
  if (value->kind != Kind::list || value->items.size() != 3)
    return fault(value->place, fmt::format("{} is not a list of three numbers", key));
  double v[3];
  for (size_t i = 0; i < 3; ++i) {
    const JsonValue& item = value->items[i];
    if (item.kind != Kind::number)
      return fault(item.place, fmt::format("{} holds something else than a number", key));
    v[i] = item.number;
  }
  const double length = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  constexpr double tolerance = 1e-3;  // three digits typed by hand are welcome
  if (!(std::abs(length - 1) <= tolerance))
    return fault(value->place, fmt::format("{} has the length {:.6g}, expected a unit direction", key, length),
                 "divide it by its length");
  return Vec3(float(v[0] / length), float(v[1] / length), float(v[2] / length));
}
}  // namespace

std::vector<LobePair> read_lobe_pairs(const std::filesystem::path& path) {
  return parse_lobe_pairs(read_text_file(path, json_most_bytes), path.string());
}

std::vector<LobePair> parse_lobe_pairs(const std::string& text, const std::string& file) {
  const JsonDocument document = parse_json(text, file);
  std::vector<Diagnostic> faults = document.problems;
  std::vector<LobePair> pairs;
  const JsonValue* rows = document.root.kind == Kind::object ? document.root.find("rows") : nullptr;
  if (!rows || rows->kind != Kind::list) {
    faults.push_back(diagnostic_at(document, rows ? rows->place : document.root.place,
                                   rows ? "\"rows\" is not a list" : "there is no list \"rows\" at the top level",
                                   "expected {\"rows\": [{\"wi\": [x, y, z], \"wo\": [x, y, z]}, ...]}"));
    throw InputError(InputError::Kind::wrong, faults);
  }
  for (const JsonValue& row : rows->items) {
    if (row.kind != Kind::object) {
      faults.push_back(diagnostic_at(document, row.place, "the row is not an object with wi and wo"));
      continue;
    }
    LobePair pair;
    pair.wi = read_direction(document, row, "wi", faults);
    pair.wo = read_direction(document, row, "wo", faults);
    pairs.push_back(pair);
  }
  if (!faults.empty()) throw InputError(InputError::Kind::wrong, faults);
  return pairs;
}

std::vector<BsdfValue> lobe_values(const Fabric& fabric, FabricSampler sampler, const std::vector<LobePair>& pairs) {
  std::vector<BsdfValue> values(pairs.size());
  const auto view = std::make_unique<FabricView>();
  for (size_t i = 0; i < pairs.size(); ++i) {
    if (!(pairs[i].wo.z > 0)) continue;
    prepare_view(fabric, pairs[i].wo, sampler, *view);
    values[i] = evaluate_with_pdf(*view, pairs[i].wi);
  }
  return values;
}

std::string lobe_values_text(const std::vector<BsdfValue>& values) {
  std::string text = "{\"rows\": [";
  for (size_t i = 0; i < values.size(); ++i)
    text += fmt::format("{}\n{{\"f\": [{:.9g}, {:.9g}, {:.9g}], \"pdf\": {:.9g}}}", i ? "," : "", values[i].f_cos.x,
                        values[i].f_cos.y, values[i].f_cos.z, values[i].pdf);
  return text + "\n]}\n";
}

const std::vector<std::string>& sampler_names() {
  static const std::vector<std::string> names{"uniform", "talk", "table"};
  return names;
}

FabricSampler sampler_from_name(const std::string& name) {
  const auto& names = sampler_names();
  for (size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return FabricSampler(i);
  throw InputError(fmt::format("there is no sampler {}", shown_name(name)), suggestion(name, names));
}

}  // namespace sateen
