#include "image/picture_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "base/missing_file.h"
#include "base/printable.h"
#include "image/light_file.h"

namespace sateen {

namespace fs = std::filesystem;

namespace {
// Pictures begin with numbers; these begin with letters for longer than `text_length`, or might.
constexpr const char* begins_with_letters[] = {"P1",     "P2",          "P3",      "P4",   "P5",     "P6",
                                               "P7",     "PF",          "Pf",      "#?",   "SIMPLE", "FUJIFILM",
                                               "/* XPM", "static char", "#define", "GIF8", "SDPX",   "XPDS"};
constexpr size_t text_length = 32;

bool is_text(const std::string& bytes) {
  if (bytes.empty()) return false;
  for (const char* begin : begins_with_letters)
    if (bytes.rfind(begin, 0) == 0) return false;
  return std::all_of(bytes.begin(), bytes.end(),
                     [](char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\r' || c == '\t'; });
}
}  // namespace

void check_picture_file(const fs::path& path) {
  std::error_code code;
  const fs::file_status status = fs::status(path, code);
  if (status.type() == fs::file_type::not_found) refuse_picture(path, "no such file", missing_file_help(path));
  if (status.type() == fs::file_type::directory) refuse_picture(path, "is a folder, expected a picture");
  if (status.type() != fs::file_type::regular) refuse_picture(path, "is not a regular file");
  if (fs::file_size(path, code) == 0) refuse_picture(path, "is empty, expected a picture");
  // Loading all readers to hear that none takes it costs two seconds.
  const std::string bytes = first_bytes(path, text_length);
  if (is_text(bytes))
    refuse_picture(path, fmt::format("is text that begins with \"{}\", expected a picture",
                                     printable(bytes.substr(0, bytes.find_first_of("\r\n")).substr(0, 20))));
}

}  // namespace sateen
