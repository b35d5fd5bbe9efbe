#pragma once
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"

namespace sateen {

/// One `key=value` of a WIF text with its place. The views point into the text.
struct WifEntry {
  std::string_view key, value, line;
  int number = 0;  ///< of the line, from 1
};

struct WifSection {
  int number = 0;  ///< line of its first heading, from 1
  int lines = 0;   ///< that are neither blank nor a comment
  std::vector<WifEntry> entries;
  bool denied = false;  ///< [CONTENTS] says that it is not used
  bool named = false;   ///< [CONTENTS] says that it is
};

/// Yes or no as WIF 1.1 writes it: 1 for true, on, yes and 1; 0 for false, off, no and 0; -1 for any other word.
int wif_yes_no(std::string_view word);
inline constexpr const char* wif_yes_no_words = "true, on, yes, 1, false, off, no or 0";

/// A section's name as files write it: [WARP COLORS].
std::string upper(std::string name);

/// The text of a WIF file in sections, names in lower case, for the sections that tell a weave: their lines without
/// comments (from ; to the end, from # at the start of a line or behind a blank). Other sections are there without
/// entries, whatever text they hold, and what stands before the first is skipped. Line ends are those of any system;
/// a UTF-8 byte order mark is skipped, and so is the 0x1A of DOS at the end of the text or at either end of a line.
class WifText {
 public:
  /// `text` and `file` must outlive this. Throws InputError for what is no text; faults of lines are kept.
  WifText(const std::string& text, const std::string& file);

  /// The section, or nullptr where it is absent or [CONTENTS] denies it.
  const WifSection* used(const std::string& name) const;
  /// The section, used or not.
  const WifSection* find(const std::string& name) const;
  /// The value of a key of a used section; nullptr where it is absent or empty, which means its default.
  const WifEntry* setting(const std::string& section, const std::string& key) const;
  std::vector<std::string> section_names() const;

  void fault(const WifEntry& entry, std::string_view at, std::string message, std::string help = {});
  void fault(std::string message, std::string help = {});
  /// Throws the faults that there are.
  void finish() const;

  std::vector<Diagnostic> faults;  ///< at most 20

 private:
  void split(std::string_view text);
  void heading(std::string_view body, const WifEntry& line);
  void obey_contents();

  const std::string& file_;
  std::map<std::string, WifSection> sections_;
  WifSection* current_ = nullptr;
  bool keeps_entries_ = false;
  WifEntry first_stray_;  ///< the first line before any section
};

}  // namespace sateen
