// A checkpoint's bytes before the hash that ends it: the hash is made right, or nothing behind it would ever be read.
// What is taken must be fit to be looked at, developed, joined and written again, to the same bytes.
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#include "base/error.h"
#include "base/files.h"
#include "film/develop.h"
#include "film/error.h"
#include "render/checkpoint.h"

namespace {

using namespace sateen;
namespace fs = std::filesystem;

/// A folder in memory where there is one, gone with the program.
struct Folder {
  std::string path;
  Folder() {
    path = (fs::exists("/dev/shm") ? "/dev/shm" : fs::temp_directory_path().string()) + "/sateen-fuzz-XXXXXX";
    if (!::mkdtemp(path.data())) std::abort();
  }
  ~Folder() {
    std::error_code ignored;
    fs::remove_all(path, ignored);
  }
};

void put(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << bytes;
}

std::string get(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Folder folder;
  const std::string in = folder.path + "/in", out = folder.path + "/out";
  std::string bytes(reinterpret_cast<const char*>(data), size);
  const std::uint64_t hash = Hash().add(bytes).value;
  bytes.append(reinterpret_cast<const char*>(&hash), sizeof hash);
  put(in, bytes);
  try {
    const Checkpoint c = read_checkpoint(in);
    check_same_job(in, c.facts, c.facts);
    write_checkpoint(out, c);
    if (get(out) != bytes) std::abort();
    if (c.film.pixels.size() <= 4096) {
      develop_layers(c.film);
      deviation_of_share(c.film, pixel_errors(c.film, {}));
      merge_checkpoints({in});
    }
  } catch (const InputError& error) {
    if (error.diagnostics.empty() || *error.what() == '\0') std::abort();
  }
  return 0;
}
