#include "render/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "base/error.h"
#include "base/file_writer.h"
#include "base/files.h"
#include "base/missing_file.h"
#include "look/json.h"

namespace sateen {

namespace {

// The number counts up with every change of what follows.
constexpr char magic[16] = "sateen render 3";

/// Values to bytes and back, in one order for both, so that writing and reading cannot differ.
class Writer {
 public:
  explicit Writer(FileWriter& out) : out_(out) {}
  void bytes(const void* data, size_t size) {
    out_.write(data, size);
    hash_.add_bytes(data, size);
  }
  template <class T>
  void value(const T& v) {
    static_assert(std::is_standard_layout_v<T>);
    bytes(&v, sizeof v);
  }
  void value(const std::string& text) {
    value(std::uint64_t(text.size()));
    bytes(text.data(), text.size());
  }
  void flag(bool v) { value(std::uint8_t(v)); }
  void array(const std::vector<std::string>& all) {
    value(std::uint64_t(all.size()));
    for (const std::string& each : all) value(each);
  }
  template <class T>
  void array(const std::vector<T>& all) {
    value(std::uint64_t(sizeof(T)));
    value(std::uint64_t(all.size()));
    bytes(all.data(), all.size() * sizeof(T));
  }
  std::uint64_t hash() const { return hash_.value; }

 private:
  FileWriter& out_;
  Hash hash_;
};

/// What is thrown where a file is not what a Writer wrote.
struct Damaged {};

/// Straight into place: the film is most of the file, and is not held twice.
class Reader {
 public:
  Reader(std::istream& in, std::uint64_t size) : in_(in), left_(size) {}
  void bytes(void* data, size_t size) {
    if (size > left_) throw Damaged();
    if (size == 0) return;  // an empty vector's data may be null
    in_.read(static_cast<char*>(data), std::streamsize(size));
    if (std::uint64_t(in_.gcount()) != size) throw Damaged();
    hash_.add_bytes(data, size);
    left_ -= size;
  }
  template <class T>
  void value(T& v) {
    bytes(&v, sizeof v);
  }
  void value(std::string& text) {
    text.resize(size_t(count(1)));
    bytes(text.data(), text.size());
  }
  void flag(bool& v) {
    std::uint8_t byte = 0;
    value(byte);
    if (byte > 1) throw Damaged();
    v = byte == 1;
  }
  void array(std::vector<std::string>& all) {
    all.resize(size_t(count(sizeof(std::uint64_t))));
    for (std::string& each : all) value(each);
  }
  template <class T>
  void array(std::vector<T>& all) {
    // Of a program whose values have another shape.
    std::uint64_t size = 0;
    value(size);
    if (size != sizeof(T)) throw Damaged();
    all.resize(size_t(count(sizeof(T))));
    bytes(all.data(), all.size() * sizeof(T));
  }
  std::uint64_t hash() const { return hash_.value; }
  std::uint64_t left() const { return left_; }

 private:
  // A damaged count must not become a request for memory.
  std::uint64_t count(size_t each) {
    std::uint64_t n = 0;
    value(n);
    if (n > left_ / each) throw Damaged();
    return n;
  }

  std::istream& in_;
  std::uint64_t left_;
  Hash hash_;
};

template <class Stream, class C>
void exchange(Stream& s, C& c) {
  s.array(c.words);
  s.value(c.plan);
  s.value(c.candidates_reason);
  s.value(c.film.width);
  s.value(c.film.height);
  s.value(c.film.first_sample);
  s.value(c.film.grain);
  s.flag(c.film.opaque);
  s.array(c.film.pixels);
  s.array(c.film.layers);
  s.value(c.course.samples);
  s.value(c.course.barrier);
  s.array(c.course.targets);
  s.array(c.course.past);
  s.flag(c.course.promise.made);
  s.value(c.course.promise.made_at_seconds);
  s.value(c.course.promise.error);
  s.value(c.course.promise.samples);
  s.value(c.course.promise.seconds);
  s.value(c.course.promise.cpu_seconds);
  s.value(c.course.promised_for.spp);
  s.value(c.course.promised_for.error);
  s.value(c.course.promised_for.seconds);
  s.value(c.course.seconds);
  s.value(c.course.cpu_seconds);
  s.value(c.course.rays.camera);
  s.value(c.course.rays.shadow);
  s.value(c.course.rays.bounce);
  s.value(c.course.rays.lit);
  s.value(c.course.rays.shadow_after);
  s.value(c.course.rays.lit_after);
  s.value(c.course.rays.non_finite);
}

[[noreturn]] void damaged(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("{} {}", shown_name(path.string()), what),
                   "a checkpoint is what sateen render --checkpoint writes, and a render that a signal stopped",
                   InputError::Kind::unreadable);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& c) {
  std::uint64_t meant = 0;
  const auto write = [&](const std::filesystem::path& temporary) {
    FileWriter out(temporary);
    Writer writer(out);
    writer.value(magic);
    writer.value(std::uint64_t(c.facts.size()));
    for (const Fact& fact : c.facts) {
      writer.value(fact.name);
      writer.value(fact.value);
      writer.value(fact.shown);
    }
    exchange(writer, c);
    writer.value(std::uint64_t(writer.hash()));
    meant = writer.hash();
    out.close();
  };
  write_file_whole(path, write, [&](const std::filesystem::path& temporary) {
    std::ifstream in(temporary, std::ios::binary);
    Hash back;
    std::vector<char> block(1 << 20);
    while (in.read(block.data(), std::streamsize(block.size())), in.gcount() > 0)
      back.add_bytes(block.data(), size_t(in.gcount()));
    if (back.value != meant) throw OperationError("what is read back differs from what was written");
  });
}

namespace {
/// Sums of light that can be squared: a map's brightest texel is 1e35.
bool is_sound(const FilmPixel& pixel) {
  const auto fits = [](double sum) { return std::abs(sum) < 1e60; };  // false of what is no number
  for (size_t r = 0; r < size_t(replicates); ++r) {
    const Vec3d& sum = pixel.beauty[r];
    if (!fits(sum.x) || !fits(sum.y) || !fits(sum.z) || !fits(pixel.coverage[r])) return false;
  }
  return pixel.samples < (std::uint64_t(1) << 40);
}

/// Whether what was read fits together: counts, and numbers that something is divided by or indexed with.
bool is_sound(const Checkpoint& c) {
  const size_t pixels = c.film.pixels.size();
  return c.film.width > 0 && c.film.height > 0 && pixels == size_t(c.film.width) * size_t(c.film.height) &&
         (c.film.layers.empty() || c.film.layers.size() == pixels) && c.course.targets.size() == pixels &&
         c.film.grain > 0 && std::isfinite(c.film.grain) && c.film.first_sample % replicates == 0 &&
         c.course.samples >= 0 && c.course.barrier >= 0 &&
         std::all_of(c.film.pixels.begin(), c.film.pixels.end(), [](const FilmPixel& p) { return is_sound(p); });
}
}  // namespace

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  std::error_code code;
  const std::filesystem::file_status status = std::filesystem::status(path, code);
  const auto unreadable = [&](const std::string& why, const std::string& help = {}) {
    throw InputError(fmt::format("{}: {}", path.string(), why), help, InputError::Kind::unreadable);
  };
  if (status.type() == std::filesystem::file_type::not_found) unreadable("no such file", missing_file_help(path));
  if (status.type() != std::filesystem::file_type::regular) unreadable("is not a regular file");
  const std::uint64_t size = std::filesystem::file_size(path, code);
  std::ifstream in(path, std::ios::binary);
  if (code || !in) unreadable(code ? code.message() : std::strerror(errno));
  Checkpoint c;
  Reader reader(in, size);
  try {
    char found[sizeof magic];
    reader.value(found);
    if (std::memcmp(found, magic, sizeof magic) != 0) damaged(path, "is no checkpoint, or one of another version");
    std::uint64_t facts = 0;
    reader.value(facts);
    if (facts > 1000) throw Damaged();
    c.facts.resize(size_t(facts));
    for (Fact& fact : c.facts) {
      reader.value(fact.name);
      reader.value(fact.value);
      reader.value(fact.shown);
    }
    exchange(reader, c);
    const std::uint64_t expected = reader.hash();
    std::uint64_t hash = 0;
    reader.value(hash);
    if (hash != expected || reader.left() != 0 || !is_sound(c)) throw Damaged();
  } catch (const Damaged&) {
    damaged(path, "is damaged: it is not what was written");
  }
  return c;
}

void check_same_job(const std::filesystem::path& path, const std::vector<Fact>& then, const std::vector<Fact>& now) {
  const auto text = [](const Fact& f) { return !f.shown.empty() ? f.shown : f.value.empty() ? "empty" : f.value; };
  std::string differences;
  for (const Fact& fact : now) {
    const auto found = std::find_if(then.begin(), then.end(), [&](const Fact& f) { return f.name == fact.name; });
    if (found != then.end() && found->value == fact.value) continue;
    differences += fmt::format("{}{} is {} there and {} here", differences.empty() ? "" : "; ", fact.name,
                               found == then.end() ? "nothing" : text(*found), text(fact));
  }
  if (differences.empty() && then.size() == now.size()) return;
  throw InputError(fmt::format("{} is of another picture: {}", shown_name(path.string()), differences),
                   "give the flags that it was begun with; only error, time, samples and what is shown may change");
}

Checkpoint merge_checkpoints(const std::vector<std::filesystem::path>& paths) {
  struct Part {
    std::filesystem::path path;
    std::uint64_t first = 0, end = 0;
  };
  std::vector<Part> parts;
  Checkpoint sum;
  for (const std::filesystem::path& path : paths) {
    Checkpoint c = read_checkpoint(path);
    if (!parts.empty()) check_same_job(path, c.facts, sum.facts);
    const std::uint64_t first = c.film.first_sample, count = std::uint64_t(c.course.samples);
    for (const FilmPixel& pixel : c.film.pixels)
      if (pixel.samples != count && pixel.samples != 0)
        throw InputError(
            fmt::format("{} does not hold the same number of samples everywhere", shown_name(path.string())),
            "finish it with --resume, and render what is to be merged with --no-adaptive and --spp");
    for (const Part& other : parts)
      if (first < other.end && other.first < first + count)
        throw InputError(
            fmt::format("{} holds samples {} to {}, which {} holds as well", shown_name(path.string()),
                        std::max(first, other.first), std::min(first + count, other.end) - 1,
                        shown_name(other.path.string())),
            "renders that are merged take other samples each: --samples-from 0, 128, 256 ... with --spp 128");
    parts.push_back({path, first, first + count});
    if (parts.size() == 1) {
      sum = std::move(c);
      continue;
    }
    add_film(sum.film, c.film);
    sum.course.samples += c.course.samples;
    sum.course.seconds += c.course.seconds;
    sum.course.cpu_seconds += c.course.cpu_seconds;
    sum.course.rays.add(c.course.rays);
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.first < b.first; });
  for (size_t i = 1; i < parts.size(); ++i) {
    if (parts[i].first != parts[i - 1].end)
      throw InputError(fmt::format("samples {} to {} are in none of the files", parts[i - 1].end, parts[i].first - 1),
                       "render them too: --samples-from " + std::to_string(parts[i - 1].end));
  }
  // Where all targets are the same, the next barrier is enough to go on.
  Course& course = sum.course;
  course.past.clear();
  course.promise = {};
  course.barrier = next_barrier(course.samples);
  for (size_t i = 0; i < course.targets.size(); ++i)
    course.targets[i] = sum.film.pixels[i].samples > 0 ? std::uint32_t(course.barrier) : 0;
  return sum;
}

}  // namespace sateen
