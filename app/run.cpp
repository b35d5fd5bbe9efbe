#include "run.h"

#include <fmt/format.h>

#include <chrono>
#include <exception>
#include <new>

#include "base/error.h"
#include "base/nearest_name.h"
#include "base/parallel.h"
#include "command.h"
#include "commands.h"
#include "console.h"
#include "exit_code.h"
#include "image/color_messages.h"
#include "look/json.h"
#include "signals.h"
#include "stack.h"

namespace sateen::app {

namespace {
const auto program_start = std::chrono::steady_clock::now();
}

double seconds_since_start() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - program_start).count();
}

const std::vector<Subcommand>& subcommands() {
  static const std::vector<Subcommand> all{
      {"render", "one picture of a cloth", run_render},
      {"merge", "joins renders of different samples of one picture", run_merge},
      {"turntable", "an orbit: frames and a sheet of them", run_turntable},
      {"plan", "which effects a picture is rendered with, and why", run_plan},
      {"cost", "what accuracy costs in time, and what approximations give away", run_cost},
      {"study", "measures the sampling strategies against each other", run_study},
      {"look", "looks: list, check, resolve, diff, schema", run_look},
      {"lobe", "draws and prints how a look scatters light", run_lobe},
      {"env", "lights: list, inspect, make", run_env},
      {"check", "what is wrong with looks, meshes and HDR maps, and what to do", run_check},
  };
  return all;
}

namespace {
std::string overview() {
  std::string text =
      "Sateen renders woven cloth: a look, a mesh and an HDR map in, a colour-managed picture out.\n\n"
      "  sateen render                 the default satin: sateen.png and sateen.exr\n"
      "  sateen COMMAND --help         flags and examples of a command\n\nCommands\n";
  for (const Subcommand& each : subcommands()) text += fmt::format("  {:<12}{}\n", each.name, each.summary);
  text +=
      "\nExit codes\n"
      "  0  done                                    3  a file is missing or unreadable\n"
      "  1  rendering or writing failed             4  stopped before the asked quality\n"
      "  2  wrong use, or a file with wrong content 5  samples that are not finite, with --strict\n"
      "  129, 130, 143  stopped by a signal; what was rendered so far is written, --resume goes on from it\n\n"
      "Environment: SATEEN_PATH (folders with looks/ and envmaps/, separated by colons), SATEEN_HOME (the program's\n"
      "own), OCIO (a colour config), SLURM_CPUS_PER_TASK.\n";
  return text;
}

int run_help(const std::vector<std::string>& words) {
  if (words.empty()) {
    print_result(overview());
    return done;
  }
  std::vector<std::string> asked = words;
  asked.push_back("--help");
  return run_named(subcommands(), "sateen", asked);
}

int dispatch(const std::vector<std::string>& words) {
  if (words.empty() || words[0] == "--help" || words[0] == "-h") return run_help({});
  if (words[0] == "help") return run_help({words.begin() + 1, words.end()});
  if (words[0] == "--version" || words[0] == "-V" || words[0] == "version") {
    print_result("sateen " SATEEN_VERSION);
    return done;
  }
  if (words[0][0] == '-')
    throw InputError(fmt::format("a command is missing before {}", shown_name(words[0])),
                     fmt::format("sateen render {}", words[0]));
  provide_stack();
  return run_named(subcommands(), "sateen", words);
}
}  // namespace

int run_group(const std::string& prefix, const std::string& summary, const std::vector<Subcommand>& table,
              const std::vector<std::string>& words) {
  if (!words.empty() && words[0] != "--help" && words[0] != "-h") return run_named(table, prefix, words);
  std::string text = summary + "\n\n";
  for (const Subcommand& each : table) text += fmt::format("  {} {:<9} {}\n", prefix, each.name, each.summary);
  print_result(text + fmt::format("\n{} COMMAND --help shows flags and examples.\n", prefix));
  return done;
}

int run_named(const std::vector<Subcommand>& table, const std::string& prefix,
              const std::vector<std::string>& words) {
  std::vector<std::string> names;
  for (const Subcommand& each : table) names.push_back(each.name);
  if (words.empty()) throw InputError(fmt::format("{} wants a command", prefix), suggestion("", names));
  for (const Subcommand& each : table)
    if (each.name == words[0]) return each.run({words.begin() + 1, words.end()});
  throw InputError(fmt::format("there is no command {} {}", prefix, shown_name(words[0])),
                   suggestion(words[0], names));
}

int run(int argc, char** argv) {
  install_signals();
  flush_denormals();
  hear_color_messages([](const std::string& message) { print_warning("colour config: " + message); });
  int code = done;
  try {
    code = dispatch({argv + (argc > 0), argv + argc});
  } catch (const UsageError& error) {
    print_error(fmt::format("{}\n{}", error.what(), error.usage));
    code = wrong_use;
  } catch (const InputError& error) {
    print_error(error.what());
    code = error.kind == InputError::Kind::unreadable ? unreadable : wrong_use;
  } catch (const OperationError& error) {
    print_error(fmt::format("error: {}", error.what()));
    code = failed;
  } catch (const std::bad_alloc&) {
    print_error("error: not enough memory\n  help: a lower --level or a smaller --res needs less");
    code = failed;
  } catch (const std::exception& error) {
    print_error(fmt::format("error: something failed that should not have; please report it ({})", error.what()));
    code = failed;
  }
  if (!finish_output() && code == done) {
    print_error("error: standard output cannot be written");
    code = failed;
  }
  return code;
}

}  // namespace sateen::app
