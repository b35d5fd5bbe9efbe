#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "look/find.h"
#include "look/look.h"

namespace sateen {

/// Where the value of a field comes from.
struct FieldOrigin {
  std::string path;    ///< "warp.gamma_s_deg"
  std::string value;   ///< as JSON
  std::string origin;  ///< "looks/silk.json:14", "default", or "--set"
};

/// A look with its parents merged, and the origin of every value.
struct ResolvedLook {
  Look look;
  std::vector<FieldOrigin> values;  ///< in the order of fields(); fields that hold nothing are left out
  std::vector<std::string> files;   ///< the look's own, then its parent's, and so on
};

/// Reads the look of that name or path (see find_look), merges the looks it inherits from, and applies the
/// overrides. InputError with every fault of the files at once: unreadable when the look itself is missing, else
/// wrong.
///
/// What a file gives replaces what its parent gives, field by field; title and description are never inherited. A
/// family's color drops an inherited A and the other way round. Colours keep the space of the file they stand in.
ResolvedLook resolve_look(const std::string& name_or_path, const std::vector<std::string>& overrides = {},
                          const std::vector<std::filesystem::path>& extra_folders = {});

/// The look of resolve_look.
Look read_look(const std::string& name_or_path, const std::vector<std::string>& overrides = {},
               const std::vector<std::filesystem::path>& extra_folders = {});

/// The look of a text; `file` names it in messages, gives the look its name, and is where `inherits` and `back`
/// are searched first.
Look parse_look(const std::string& text, const std::string& file,
                const std::vector<std::filesystem::path>& extra_folders = {});

/// The look that `look.back` names; `look` itself, when that is empty, must not be passed.
Look read_back(const Look& look, const std::vector<std::filesystem::path>& extra_folders = {});

/// The look that `look.pattern_look` names, which must not be empty. InputError where that one has a pattern too.
Look read_pattern(const Look& look, const std::vector<std::filesystem::path>& extra_folders = {});

/// Applies "path=value" texts as from the command line, such as "warp.gamma_s_deg=4" or "color=[0.1, 0.2, 0.6]"
/// (brackets and quotes may be left out). Ranges are checked one by one, consistency after the last. On InputError
/// the look is unchanged.
void apply_overrides(Look& look, const std::vector<std::string>& overrides);
void apply_override(Look& look, const std::string& override_text);

}  // namespace sateen
