#include "outputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "base/file_identity.h"
#include "console.h"
#include "exit_code.h"
#include "look/json.h"
#include "picture_report.h"

namespace sateen::app {

namespace fs = std::filesystem;

std::vector<NamedFile> named_outputs(const std::vector<std::string>& pictures, const std::vector<NamedFile>& others) {
  std::vector<NamedFile> all;
  const auto add = [&](const NamedFile& file) {
    if (file.path.empty()) return;
    for (const NamedFile& other : all) {
      if (!same_file(other.path, file.path)) continue;
      const std::string first = other.path == file.path ? other.role : other.role + " " + shown_name(other.path);
      throw InputError(fmt::format("{} is given twice: {}", shown_name(file.path),
                                   first == file.role ? "both times as " + first
                                                      : fmt::format("as {} and as {}", first, file.role)),
                       "each file is written once: leave one of them out, or name another file");
    }
    all.push_back(file);
  };
  for (const std::string& picture : pictures) add({"--output", picture});
  for (const NamedFile& other : others) add(other);
  return all;
}

namespace {
/// What a file that was read is to people.
std::string role_of(const fs::path& path) {
  const std::string extension = path.extension().string();
  if (extension == ".json") return "look or description";
  if (extension == ".obj") return "mesh";
  if (extension == ".wif") return "draft";
  if (extension == ".exr" || extension == ".hdr") return "map or texture";
  return "file";
}

std::vector<NamedFile> all_inputs(std::vector<NamedFile> inputs) {
  for (const fs::path& path : files_read()) inputs.push_back({role_of(path), path.string()});
  return inputs;
}

[[noreturn]] void refuse(const NamedFile& output, const NamedFile& input) {
  const bool same_name = output.path == input.path;
  throw InputError(fmt::format("{} {} is also the {} that is read{}", output.role, shown_name(output.path),
                               input.role, same_name ? "" : fmt::format(" ({})", shown_name(input.path))),
                   "nothing was rendered; name another file to write");
}
}  // namespace

void check_not_read(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs) {
  for (const NamedFile& input : all_inputs(inputs))
    for (const NamedFile& output : outputs)
      if (!output.path.empty() && !input.path.empty() && same_file(output.path, input.path)) refuse(output, input);
}

void check_report_folder(const std::string& folder, const std::vector<std::string>& names,
                         const std::vector<NamedFile>& inputs) {
  std::error_code code;
  for (const NamedFile& input : all_inputs(inputs)) {
    for (const std::string& name : names)
      if (const std::string file = (fs::path(folder) / name).string(); same_file(file, input.path))
        refuse({"--output", file}, input);
    // Drawings and pictures have many names.
    const fs::path place = fs::weakly_canonical(fs::absolute(input.path, code), code);
    for (const char* inside : {".", "pictures"})
      if ((place.extension() == ".png" || place.extension() == ".svg") &&
          fs::equivalent(place.parent_path(), fs::path(folder) / inside, code))
        refuse({"--output", (fs::path(folder) / inside / place.filename()).lexically_normal().string()}, input);
  }
}

std::vector<NamedFile> config_input(const std::string& ocio) {
  const char* set = std::getenv("OCIO");
  const std::string config = !ocio.empty() ? ocio : set ? set : "";
  std::error_code code;
  if (!fs::is_regular_file(config, code)) return {};
  return {{"colour config", config}};
}

bool Endings::attempt(const std::function<void()>& write) {
  try {
    write();
    return true;
  } catch (const std::bad_alloc&) {
    print_error("error: not enough memory to write");
  } catch (const OperationError& error) {
    print_error(fmt::format("error: {}", error.what()));
  } catch (const std::exception& error) {
    print_error(error.what());
  }
  failed_ = true;
  return false;
}

void Endings::tell(const PictureJob& job, const WrittenPictures& pictures) {
  for (const WrittenPicture& file : pictures.written) print_written(job, file);
  for (const std::string& failure : pictures.failures) print_error("error: " + failure);
  failed_ |= !pictures.failures.empty();
}

int Endings::code(int code) const {
  return failed_ && code < 128 ? int(failed) : code;
}

std::vector<std::string> names_for_partial(const std::vector<std::string>& outputs) {
  const std::vector<std::string> names = partial_names(outputs);
  for (size_t i = 0; i < names.size(); ++i)
    if (names[i] != outputs[i])
      print_note(
          fmt::format("{} holds a finished picture and stays; the one so far goes to {}", outputs[i], names[i]));
  return names;
}

}  // namespace sateen::app
