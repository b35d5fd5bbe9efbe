#include "command.h"

#include <fmt/format.h>
#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstdio>

#include "base/nearest_name.h"
#include "console.h"
#include "look/json.h"

namespace sateen::app {

namespace {
struct Flag {
  std::string group, names, value, help;
};

std::string long_name(const std::string& names) {
  return names.substr(names.find("--"));
}

// "-o,--output" as "-o, --output"; without a short twin the column stays free.
std::string shown_names(const std::string& names) {
  return names[1] == '-' ? "    " + names : names.substr(0, 2) + ", " + long_name(names);
}

std::string wrapped(const std::string& text, size_t indent, size_t width) {
  std::string out, line;
  const auto flush = [&] {
    out += (out.empty() ? "" : "\n" + std::string(indent, ' ')) + line;
    line.clear();
  };
  size_t at = 0;
  while (at < text.size()) {
    const size_t end = std::min(text.find(' ', at), text.size());
    if (!line.empty() && indent + line.size() + 1 + end - at > width) flush();
    line += (line.empty() ? "" : " ") + text.substr(at, end - at);
    at = end + 1;
  }
  flush();
  return out;
}
}  // namespace

struct Phrase {
  std::string names;
  std::function<bool(const std::string&)> joins;
};

// Whether the word is that flag, or begins --flag=value.
bool is_flag(const std::string& word, const std::string& names) {
  const std::string name = word.substr(0, word.find('='));
  return name == long_name(names) || (names[1] != '-' && name == names.substr(0, 2));
}

struct Command::State {
  std::string name, summary, usage, current_group = "Flags";
  std::vector<std::string> paragraphs;
  std::vector<Flag> flags;
  std::vector<std::pair<std::string, std::string>> examples;
  std::vector<std::string> long_names, words;
  std::vector<std::string> switches{"--help"};  // flags that want no value, with their twins
  std::vector<Phrase> phrases;
  std::string argument, argument_help;
  std::vector<std::string>* arguments = nullptr;
  int fewest_arguments = 0, most_arguments = 0;
  bool help_asked = false;
  std::vector<Diagnostic> faults;
  CLI::App app;

  void add(const std::string& names, const std::string& value, const std::string& help_text) {
    flags.push_back({current_group, names, value, help_text});
    long_names.push_back(long_name(names));
  }
  void fault(const InputError& error) {
    faults.insert(faults.end(), error.diagnostics.begin(), error.diagnostics.end());
  }
  std::string usage_line() const { return fmt::format("usage: sateen {} {}", name, usage); }
  std::vector<std::string> settled(const std::vector<std::string>& typed);
  void collect_leftovers();
};

// The words as the parser wants them: -look means --look, and the words of a phrase become one.
std::vector<std::string> Command::State::settled(const std::vector<std::string>& typed) {
  const auto is_known = [&](const std::string& flag) {
    return std::find(long_names.begin(), long_names.end(), flag) != long_names.end();
  };
  std::vector<std::string> out;
  for (size_t i = 0; i < typed.size(); ++i) {
    std::string word = typed[i];
    if (word == "--") {
      out.insert(out.end(), typed.begin() + std::ptrdiff_t(i), typed.end());
      break;
    }
    if (word.size() > 2 && word[0] == '-' && word[1] != '-') {
      const std::string doubled = "-" + word, flag = doubled.substr(0, doubled.find('='));
      if (is_known(flag)) word = doubled;
    }
    // The parser would take the next word instead.
    if (word.ends_with('=') && is_known(word.substr(0, word.size() - 1))) {
      fault(InputError(word.substr(0, word.size() - 1) + " is empty"));
      continue;
    }
    // The parser would count it, or fail.
    const size_t equals = std::min(word.find('='), word.size());
    if (const std::string flag = word.substr(0, equals), value = word.substr(equals);
        !value.empty() && value != "=true" && value != "=false" &&
        std::find(switches.begin(), switches.end(), flag) != switches.end()) {
      fault(InputError(
          fmt::format("{} is {}, expected no value, or true or false", flag, shown_name(value.substr(1)))));
      continue;
    }
    out.push_back(word);
    for (const Phrase& phrase : phrases) {
      if (!is_flag(word, phrase.names)) continue;
      if (word.find('=') == std::string::npos && i + 1 < typed.size()) out.push_back(typed[++i]);
      while (i + 1 < typed.size() && phrase.joins(typed[i + 1])) out.back() += " " + typed[++i];
    }
  }
  return out;
}

Command::Command(std::string name, std::string summary, std::string usage) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.name = std::move(name);
  s.summary = std::move(summary);
  s.usage = std::move(usage);
  s.app.set_help_flag();
  s.app.set_config();
  s.app.allow_extras();
  s.app.add_flag("-h,--help", s.help_asked);
  s.long_names.push_back("--help");
}
Command::~Command() = default;

void Command::group(std::string title) {
  state_->current_group = std::move(title);
}
void Command::paragraph(std::string text) {
  state_->paragraphs.push_back(std::move(text));
}
void Command::example(std::string line, std::string meaning) {
  state_->examples.emplace_back(std::move(line), std::move(meaning));
}

void Command::flag(const std::string& names, bool& to, const std::string& help) {
  const std::string no = "--no-" + long_name(names).substr(2);
  state_->add(names, "", help);
  state_->long_names.push_back(no);
  state_->switches.insert(state_->switches.end(), {long_name(names), no});
  state_->app.add_flag_function(names + ",!" + no, [&to](std::int64_t count) { to = count > 0; });
}

void Command::custom(const std::string& names, const std::string& value, int fewest, int most,
                     std::function<void(const std::vector<std::string>&)> read, const std::string& help) {
  State* s = state_.get();
  s->add(names, value, help);
  s->app
      .add_option(names,
                  [s, names, value, fewest, read = std::move(read)](const std::vector<std::string>& words) {
                    try {
                      // The parser counts the values of one use together with those of another.
                      if (int(words.size()) < fewest)
                        throw InputError(fmt::format("{} wants {} values: {}", long_name(names), fewest, value));
                      read(words);
                    } catch (const InputError& error) {
                      s->fault(error);
                    }
                    return true;
                  })
      ->type_size(1)
      ->expected(fewest, most)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast)
      ->allow_extra_args(false);
}

void Command::text(const std::string& names, const std::string& value, std::string& to, const std::string& help) {
  custom(
      names, value, 1, 1,
      [&to, names](const std::vector<std::string>& words) {
        if (words.back().empty()) throw InputError(long_name(names) + " is empty");
        to = words.back();
      },
      help);
}

void Command::texts(const std::string& names, const std::string& value, std::vector<std::string>& to,
                    const std::string& help) {
  state_->add(names, value, help);
  state_->app
      .add_option(names,
                  [&to](const std::vector<std::string>& words) {
                    to = words;
                    return true;
                  })
      ->type_size(1)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false);
}

void Command::choice(const std::string& names, std::string& to, std::vector<std::string> known,
                     const std::string& help) {
  std::string value;
  for (const std::string& each : known) value += (value.empty() ? "" : "|") + each;
  custom(
      names, value, 1, 1,
      [&to, names, known = std::move(known)](const std::vector<std::string>& words) {
        if (std::find(known.begin(), known.end(), words.back()) == known.end())
          throw InputError(fmt::format("{} is {}", long_name(names), shown_name(words.back())),
                           suggestion(words.back(), known));
        to = words.back();
      },
      help);
}

void Command::integer(const std::string& names, const std::string& value, int& to, long long low, long long high,
                      const std::string& help) {
  custom(
      names, value, 1, 1,
      [&to, names, low, high](const std::vector<std::string>& words) {
        to = read_integer(long_name(names), words.back(), low, high);
      },
      help);
}

void Command::number(const std::string& names, const std::string& value, double& to, double low, double high,
                     const std::string& help) {
  custom(
      names, value, 1, 1,
      [&to, names, low, high](const std::vector<std::string>& words) {
        to = read_number(long_name(names), words.back(), low, high);
      },
      help);
}

void Command::number(const std::string& names, const std::string& value, float& to, double low, double high,
                     const std::string& help) {
  custom(
      names, value, 1, 1,
      [&to, names, low, high](const std::vector<std::string>& words) {
        to = float(read_number(long_name(names), words.back(), low, high));
      },
      help);
}

void Command::share(const std::string& names, const std::string& value, double& to, double low, double high,
                    const std::string& help) {
  custom(
      names, value, 1, 1,
      [&to, names, low, high](const std::vector<std::string>& words) {
        to = read_share(long_name(names), words.back(), low, high);
      },
      help);
}

void Command::phrase(const std::string& names, const std::string& value,
                     std::function<bool(const std::string&)> joins, std::function<void(const std::string&)> read,
                     const std::string& help) {
  state_->phrases.push_back({names, std::move(joins)});
  custom(
      names, value, 1, 1, [read = std::move(read)](const std::vector<std::string>& words) { read(words.back()); },
      help);
}

void Command::arguments(const std::string& value, std::vector<std::string>& to, int fewest, int most,
                        const std::string& help) {
  State& s = *state_;
  s.argument = value;
  s.argument_help = help;
  s.arguments = &to;
  s.fewest_arguments = fewest;
  s.most_arguments = most;
}

// What no flag took: names of files and looks where the command has such, and flags that do not exist.
void Command::State::collect_leftovers() {
  std::vector<std::string> plain;
  bool only_plain = false;
  for (const std::string& word : app.remaining()) {
    if (word == "--" && !only_plain) {
      only_plain = true;
    } else if (!only_plain && word.size() > 1 && word[0] == '-') {
      const std::string flag = word.substr(0, word.find('='));
      std::string help = suggestion(flag, long_names);
      if (nearest_name(flag, long_names).empty()) {
        help = fmt::format("sateen {} --help lists the flags", name);
        for (const std::string& each : long_names)
          if (flag.size() > 3 && each.rfind(flag, 0) == 0) help = fmt::format("did you mean {}?", each);
      }
      faults.push_back(InputError(fmt::format("there is no flag {}", shown_name(flag)), help).diagnostics[0]);
    } else {
      plain.push_back(word);
    }
  }
  // The value of an unknown flag looks like an argument: one complaint is enough.
  if (!faults.empty()) return;
  const int count = int(plain.size());
  if (!arguments && count > 0) {
    faults.push_back(InputError(fmt::format("{} is not expected here", shown_name(plain[0])),
                                fmt::format("values stand behind their flags; sateen {} --help lists them", name))
                         .diagnostics[0]);
  } else if (arguments && count < fewest_arguments) {
    faults.push_back(InputError(fmt::format("{} is missing: {}", argument, argument_help)).diagnostics[0]);
  } else if (arguments && count > most_arguments) {
    faults.push_back(InputError(fmt::format("{} is one too many, expected at most {}",
                                            shown_name(plain[size_t(most_arguments)]), most_arguments))
                         .diagnostics[0]);
  }
  if (arguments) *arguments = plain;
}

bool Command::parse(const std::vector<std::string>& words) {
  State& s = *state_;
  s.words = words;
  try {
    const std::vector<std::string> settled = s.settled(words);
    s.app.parse(std::vector<std::string>(settled.rbegin(), settled.rend()));
    if (!s.help_asked) s.collect_leftovers();
  } catch (const CLI::ArgumentMismatch& error) {
    const std::string text = error.what(), flag = text.substr(0, text.find(':'));
    std::string value;
    for (const Flag& each : s.flags)
      if (long_name(each.names) == flag) value = each.value;
    s.fault(InputError(fmt::format("{} wants its value{}", flag, value.empty() ? "" : ": " + value)));
  } catch (const CLI::ParseError& error) {
    s.fault(InputError("the command line cannot be read: " + std::string(error.what())));
  }
  if (s.help_asked) {
    print_result(help());
    return false;
  }
  if (!s.faults.empty()) throw UsageError(s.faults, s.usage_line());
  return true;
}

bool Command::given(const std::string& name) const {
  return state_->app.count(name) > 0;
}

std::string Command::help() const {
  const State& s = *state_;
  constexpr size_t width = 100, column = 34;
  std::string text = fmt::format("{}\n\n  sateen {} {}\n", wrapped(s.summary, 0, width), s.name, s.usage);
  for (const std::string& each : s.paragraphs) text += "\n" + wrapped(each, 0, width) + "\n";
  const auto line = [&](const std::string& left, const std::string& right) {
    std::string out = "  " + left;
    out += out.size() + 2 > column ? "\n" + std::string(column, ' ') : std::string(column - out.size(), ' ');
    text += out + wrapped(right, column, width) + "\n";
  };
  if (s.arguments) {
    text += "\n";
    line(s.argument, s.argument_help);
  }
  std::string group;
  for (const Flag& flag : s.flags) {
    if (flag.group != group) text += "\n" + (group = flag.group) + "\n";
    line(shown_names(flag.names) + (flag.value.empty() ? "" : " " + flag.value), flag.help);
  }
  if (!s.examples.empty()) text += "\nExamples\n";
  for (const auto& [command, meaning] : s.examples)
    text += fmt::format("  {}\n      {}\n", command, wrapped(meaning, 6, width));
  return text;
}

}  // namespace sateen::app
