#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.h"

namespace sateen::app {

/// Wrong use of a command line, with the line that shows the right one.
struct UsageError : InputError {
  UsageError(std::vector<Diagnostic> all, std::string line)
      : InputError(Kind::wrong, std::move(all)), usage(std::move(line)) {}
  std::string usage;
};

/// The flags and arguments of one subcommand: reads them, checks them, and writes the help. Every fault of a command
/// line is reported in one go.
class Command {
 public:
  /// `name` as typed behind the program's, "look list"; `usage` is what follows it on the usage line.
  Command(std::string name, std::string summary, std::string usage);
  ~Command();

  void group(std::string title);     ///< heading for the flags that follow
  void paragraph(std::string text);  ///< shown under the summary
  void example(std::string line, std::string meaning);

  // `names` as "-o,--output"; `value` as shown in help, "NAME". Ranges include their ends.
  void flag(const std::string& names, bool& to, const std::string& help);  ///< with its --no- twin
  void text(const std::string& names, const std::string& value, std::string& to, const std::string& help);
  void texts(const std::string& names, const std::string& value, std::vector<std::string>& to,
             const std::string& help);  ///< may be given several times
  void choice(const std::string& names, std::string& to, std::vector<std::string> known, const std::string& help);
  void integer(const std::string& names, const std::string& value, int& to, long long low, long long high,
               const std::string& help);
  void number(const std::string& names, const std::string& value, double& to, double low, double high,
              const std::string& help);
  void number(const std::string& names, const std::string& value, float& to, double low, double high,
              const std::string& help);
  /// A share: 0.02 or 2%.
  void share(const std::string& names, const std::string& value, double& to, double low, double high,
             const std::string& help);
  /// One value that people also type as several words, "640 x 360" or "2 min": the words behind the first that
  /// `joins` are joined to it with a blank.
  void phrase(const std::string& names, const std::string& value, std::function<bool(const std::string&)> joins,
              std::function<void(const std::string&)> read, const std::string& help);
  /// Anything else: `read` gets between `fewest` and `most` words and throws InputError on what it does not like.
  void custom(const std::string& names, const std::string& value, int fewest, int most,
              std::function<void(const std::vector<std::string>&)> read, const std::string& help);
  /// Words without a flag, between `fewest` and `most`.
  void arguments(const std::string& value, std::vector<std::string>& to, int fewest, int most,
                 const std::string& help);

  /// False where help was asked for and printed.
  bool parse(const std::vector<std::string>& words);
  bool given(const std::string& long_name) const;  ///< "--spp"
  std::string help() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The whole of `text` as a number of that kind; InputError names `what` and the range.
int read_integer(const std::string& what, const std::string& text, long long low, long long high);
double read_number(const std::string& what, const std::string& text, double low, double high);
/// The same where 2% means 0.02.
double read_share(const std::string& what, const std::string& text, double low, double high);

}  // namespace sateen::app
