#pragma once
#include <string>
#include <vector>

namespace sateen::app {

/// A word that the program understands: `sateen NAME ...`. Each is called with the words behind its name.
struct Subcommand {
  std::string name, summary;
  int (*run)(const std::vector<std::string>& words);
};

int run_render(const std::vector<std::string>& words);
int run_merge(const std::vector<std::string>& words);
int run_turntable(const std::vector<std::string>& words);
int run_study(const std::vector<std::string>& words);
int run_plan(const std::vector<std::string>& words);
int run_cost(const std::vector<std::string>& words);
int run_check(const std::vector<std::string>& words);
int run_look(const std::vector<std::string>& words);
int run_lobe(const std::vector<std::string>& words);
int run_env(const std::vector<std::string>& words);

const std::vector<Subcommand>& look_subcommands();
const std::vector<Subcommand>& env_subcommands();

/// In the order of the overview.
const std::vector<Subcommand>& subcommands();

/// A command that consists of others: prints them where help is asked for, else calls the one that words[0] names.
int run_group(const std::string& prefix, const std::string& summary, const std::vector<Subcommand>& table,
              const std::vector<std::string>& words);

/// Calls the entry that words[0] names, with the rest; wrong use where there is none. `prefix`: "sateen", "sateen
/// look".
int run_named(const std::vector<Subcommand>& table, const std::string& prefix, const std::vector<std::string>& words);

}  // namespace sateen::app
