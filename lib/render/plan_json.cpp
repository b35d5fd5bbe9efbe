#include <algorithm>

#include "base/error.h"
#include "look/json.h"
#include "render/plan.h"

namespace sateen {

namespace {

[[noreturn]] void not_a_plan() {
  throw InputError("the text is no plan of this version");
}

const JsonValue& member(const JsonValue& object, const char* name, JsonValue::Kind kind) {
  const JsonValue* value = object.find(name);
  if (!value || value->kind != kind) not_a_plan();
  return *value;
}
double number(const JsonValue& object, const char* name) {
  return member(object, name, JsonValue::Kind::number).number;
}
bool truth(const JsonValue& object, const char* name) {
  return member(object, name, JsonValue::Kind::boolean).boolean;
}

std::optional<Interval> read_interval(const JsonValue& object, const char* name) {
  const JsonValue* value = object.find(name);
  if (!value) return std::nullopt;
  return Interval{number(*value, "value"), number(*value, "low"), number(*value, "high")};
}

Basis basis_from_name(const std::string& name) {
  for (const Basis basis : {Basis::look, Basis::asked, Basis::data, Basis::pilot})
    if (basis_name(basis) == name) return basis;
  not_a_plan();
}

PlannedEffect read_effect(const JsonValue& value) {
  PlannedEffect p;
  p.effect = effect_from_name(member(value, "effect", JsonValue::Kind::text).text);
  p.on = truth(value, "on");
  p.basis = basis_from_name(member(value, "basis", JsonValue::Kind::text).text);
  p.reason = member(value, "reason", JsonValue::Kind::text).text;
  p.share = read_interval(value, "share_of_light");
  p.loss = read_interval(value, "loss");
  p.cost = number(value, "cost");
  p.missing = truth(value, "missing");
  return p;
}

}  // namespace

const std::string& basis_name(Basis basis) {
  static const std::vector<std::string> names{"look", "asked", "data", "pilot"};
  return names[size_t(basis)];
}

void write_plan(JsonWriter& w, const Plan& plan) {
  const auto interval = [&](const char* name, const std::optional<Interval>& i) {
    if (i) w.key(name).open_object().member("value", i->value).member("low", i->low).member("high", i->high).close();
  };
  w.member("error", plan.error).member("error_asked", plan.error_asked).member("bounces", plan.bounces);
  w.member("bounce_share", plan.bounce_share);
  w.key("detail").open_object().member("edge_pixels", plan.detail.edge_pixels);
  w.member("off_pixels", plan.detail.off_pixels).member("normal_deg", plan.detail.normal_deg);
  w.member("rise_pixels", plan.detail.rise_pixels).close();
  w.key("effects").open_list();
  for (const PlannedEffect& p : plan.effects) {
    const EffectInfo& info = effect_info(p.effect);
    w.open_object().member("effect", info.name).member("what", info.what).member("on", p.on);
    w.member("basis", basis_name(p.basis)).member("reason", p.reason).member("switchable", info.switchable);
    interval("share_of_light", p.share);
    interval("loss", p.loss);
    w.member("cost", p.cost).member("missing", p.missing).close();
  }
  w.close();
}

std::string plan_json(const Plan& plan) {
  JsonWriter w(true);
  w.open_object();
  write_plan(w, plan);
  return w.close().text();
}

Plan read_plan(const std::string& json) {
  const JsonValue root = parse_json(json, "plan").root;
  Plan plan;
  plan.error = number(root, "error");
  plan.error_asked = truth(root, "error_asked");
  plan.bounces = int(std::clamp(number(root, "bounces"), 0.0, 64.0));
  plan.bounce_share = float(number(root, "bounce_share"));
  const JsonValue& detail = member(root, "detail", JsonValue::Kind::object);
  const auto take = [&](const char* name, float& value) { value = float(number(detail, name)); };
  take("edge_pixels", plan.detail.edge_pixels);
  take("off_pixels", plan.detail.off_pixels);
  take("normal_deg", plan.detail.normal_deg);
  take("rise_pixels", plan.detail.rise_pixels);
  for (const JsonValue& each : member(root, "effects", JsonValue::Kind::list).items)
    plan.effects.push_back(read_effect(each));
  if (plan.effects.size() != effect_list().size()) not_a_plan();
  for (size_t i = 0; i < plan.effects.size(); ++i)
    if (plan.effects[i].effect != effect_list()[i].effect) not_a_plan();
  return plan;
}

}  // namespace sateen
