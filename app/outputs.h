#pragma once
#include <functional>
#include <string>
#include <vector>

#include "picture_flags.h"
#include "render/picture.h"

namespace sateen::app {

/// A file that a command names, by what it is to it: {"--output", "a.exr"}.
struct NamedFile {
  std::string role, path;
};

/// The outputs of a command and where each is given. InputError where two are one file, by whatever name.
std::vector<NamedFile> named_outputs(const std::vector<std::string>& pictures, const std::vector<NamedFile>& others);

/// InputError where something that is to be written is also read: one of `inputs`, or any file whose content was read
/// so far (base/file_identity.h): looks and their parents, meshes, maps, textures. Called before there is anything
/// to lose.
void check_not_read(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs = {});

/// The same for a folder that a report is written into: InputError where one of its files, {"index.html",
/// "cost.json"} or any drawing or picture, is one that is read.
void check_report_folder(const std::string& folder, const std::vector<std::string>& names,
                         const std::vector<NamedFile>& inputs);

/// The colour config as an input, where it is a file.
std::vector<NamedFile> config_input(const std::string& ocio);

/// What is written at the end of a command, one thing after the other: a failure is told, and the rest is tried all
/// the same.
class Endings {
 public:
  /// False, with the reason on standard error, where `write` throws.
  bool attempt(const std::function<void()>& write);
  /// Tells every file, and every failure.
  void tell(const PictureJob& job, const WrittenPictures& pictures);
  /// What the command ends with: a signal's code stays, any other gives way to a failure.
  int code(int code) const;

 private:
  bool failed_ = false;
};

/// Where pictures that are not finished go (render/metadata.h), said where that is not where they were asked for.
std::vector<std::string> names_for_partial(const std::vector<std::string>& outputs);

}  // namespace sateen::app
