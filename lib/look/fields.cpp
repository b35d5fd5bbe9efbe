#include "look/fields.h"

namespace sateen {

namespace {

Field words(std::string key, std::string Look::*member, FieldKind kind, std::string help) {
  Field field;
  field.key = std::move(key);
  field.kind = kind;
  field.member = member;
  field.help = std::move(help);
  return field;
}

// About the file rather than the cloth.
Field remark(std::string key, std::string Look::*member, bool inherited, std::string help) {
  Field field = words(std::move(key), member, FieldKind::text, std::move(help));
  field.appearance = false;
  field.inherited = inherited;
  return field;
}

template <class Member>
Field ranged(std::string key, Member member, double low, double high, std::string unit, std::string help) {
  constexpr bool is_number = std::is_same_v<Member, float Look::*> || std::is_same_v<Member, float ThreadFamily::*> ||
                             std::is_same_v<Member, float WeaveSettings::*>;
  constexpr bool is_list = std::is_same_v<Member, std::vector<float> ThreadFamily::*>;
  Field field;
  field.key = std::move(key);
  field.kind = is_number ? FieldKind::number : is_list ? FieldKind::numbers : FieldKind::color;
  field.member = member;
  field.low = low;
  field.high = high;
  field.unit = std::move(unit);
  field.help = std::move(help);
  return field;
}

Field mapped(Field field) {
  field.mappable = true;
  return field;
}

// A new parameter is one line here, plus its use.
std::vector<Field> look_fields() {
  return {
      remark("title", &Look::title, false, "What the cloth is called"),
      remark("description", &Look::description, false, "What it looks like and what it is for"),
      remark("source", &Look::source, true, "Where the numbers come from"),
      words("color_space", &Look::color_space, FieldKind::name,
            "Space of all colours of the file that name none of their own"),
      mapped(ranged("color", OfBothFamilies{&ThreadFamily::color}, 0, 1, "",
                    "Colour of each family for which the same file gives neither color nor A")),
      ranged("masking_width_deg", &Look::masking_width_deg, 5, 60, "degrees",
             "Width of the transition between uncorrelated and correlated masking"),
      mapped(ranged("warp_angle_deg", &Look::warp_angle_deg, -180, 180, "degrees",
                    "Turns the warp about the normal, from the direction of u towards that of v")),
      words("back", &Look::back, FieldKind::look_name,
            "Look of the back of the cloth; empty for the same on both sides"),
  };
}

std::vector<Field> pattern_fields() {
  return {
      mapped(ranged("mask", &Look::pattern_mask, 0, 1, "",
                    "Where another look is woven in: 0 this look, 1 the other, between them both in these shares")),
      words("look", &Look::pattern_look, FieldKind::look_name, "The look that the pattern weaves in"),
  };
}

std::vector<Field> family_fields() {
  constexpr double most_scale = 100, longest = 1000;  // beyond any use
  return {
      mapped(ranged("eta", &ThreadFamily::eta, 1, 3, "", "Index of refraction of the thread")),
      mapped(ranged("k_d", &ThreadFamily::k_d, 0, 1, "", "Isotropic share of the light scattered inside the thread")),
      mapped(ranged("gamma_s_deg", &ThreadFamily::gamma_s_deg, 0.5, 90, "degrees",
                    "Width of the highlight at the thread's surface, as a standard deviation")),
      mapped(ranged("gamma_v_deg", &ThreadFamily::gamma_v_deg, 0.5, 180, "degrees",
                    "Width of the glow from inside the thread, as a standard deviation")),
      mapped(ranged("coverage", &ThreadFamily::coverage, 0, 1, "",
                    "Share of the cloth's area; what warp and weft leave of 1 are gaps")),
      mapped(ranged("A", &ThreadFamily::A, 0, most_scale, "",
                    "Raw scale of the light scattered inside the thread; not a reflectance")),
      mapped(ranged("color", &ThreadFamily::color, 0, 1, "",
                    "What the cloth would show in white light at normal view if both families had it; gives A")),
      ranged("offsets_deg", &ThreadFamily::offsets_deg, -90, 90, "degrees",
             "Tilts of the thread at the ends of the pieces of its tangent curve"),
      ranged("lengths", &ThreadFamily::lengths, 0, longest, "",
             "Relative length of each piece, one fewer than the offsets; 0 is a jump"),
  };
}

std::vector<Field> weave_fields() {
  Field draft;
  draft.key = "draft";
  draft.kind = FieldKind::draft;
  draft.member = &WeaveSettings::draft;
  draft.help =
      "How the threads cross, seen from near: plain, twill 3/1, satin 5/2, sateen 5/2, rows of x (warp on top) and ., "
      "or a .wif file";
  return {
      draft,
      ranged("warp_per_cm", &WeaveSettings::warp_per_cm, 0.5, 500, "", "Warp threads in a centimetre"),
      ranged("weft_per_cm", &WeaveSettings::weft_per_cm, 0.5, 500, "", "Weft threads in a centimetre"),
      ranged("irregularity", &WeaveSettings::irregularity, 0, 0.4, "",
             "How far the edges of threads stray, as a share of their spacing"),
      ranged("slubs", &WeaveSettings::slubs, 0, 1, "", "How thick the thick places of the weft are"),
  };
}

std::vector<Field> all_fields() {
  std::vector<Field> all = look_fields();
  for (Field& field : all) field.path = field.key;
  const auto add_group = [&](const std::string& name, ThreadFamily Look::*family, std::vector<Field> group) {
    for (Field& field : group) {
      field.path = name + "." + field.key;
      field.group = name;
      field.family = family;
      all.push_back(std::move(field));
    }
  };
  add_group("pattern", nullptr, pattern_fields());
  add_group("warp", &Look::warp, family_fields());
  add_group("weft", &Look::weft, family_fields());
  add_group("weave", nullptr, weave_fields());
  return all;
}

}  // namespace

const std::vector<Field>& fields() {
  static const std::vector<Field> all = all_fields();
  return all;
}

const Field* find_field(std::string_view path) {
  for (const Field& field : fields())
    if (field.path == path) return &field;
  return nullptr;
}

}  // namespace sateen
