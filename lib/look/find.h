#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace sateen {

struct LookEntry {
  std::string name;  ///< file name without extension
  std::filesystem::path path;
};

/// The file of a look, given its path or its name. A name is searched as NAME.json in ./, in `extra_folders`, in each
/// folder of $SATEEN_PATH (separated by colons) and its looks/, and in data_folder()/looks. InputError (unreadable)
/// with the nearest name when there is none.
std::filesystem::path find_look(const std::string& name_or_path,
                                const std::vector<std::filesystem::path>& extra_folders = {});

/// The same for a name that stands in the look file `file`: relative to that file's folder first.
std::filesystem::path find_look_beside(const std::string& name_or_path, const std::string& file,
                                       const std::vector<std::filesystem::path>& extra_folders = {});

/// All looks that find_look finds by name, sorted by name. In folders not called looks, files that hold no look are
/// left out.
std::vector<LookEntry> list_looks(const std::vector<std::filesystem::path>& extra_folders = {});

}  // namespace sateen
