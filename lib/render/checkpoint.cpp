#include "render/checkpoint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "base/error.h"
#include "base/files.h"
#include "look/json.h"

namespace sateen {

namespace {

// The number counts up with every change of what follows.
constexpr char magic[16] = "sateen render 3";
constexpr std::uint64_t largest_file = std::uint64_t(1) << 36;

/// Values to bytes and back, in one order for both, so that writing and reading cannot differ.
class Writer {
 public:
  explicit Writer(std::ofstream& out) : out_(out) {}
  void bytes(const void* data, size_t size) {
    out_.write(static_cast<const char*>(data), std::streamsize(size));
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
  template <class T>
  void array(const std::vector<T>& all) {
    value(std::uint64_t(all.size()));
    if constexpr (!std::is_same_v<T, std::string>)
      bytes(all.data(), all.size() * sizeof(T));
    else
      for (const T& each : all) value(each);
  }
  std::uint64_t hash() const { return hash_.value; }

 private:
  std::ofstream& out_;
  Hash hash_;
};

class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}
  void bytes(void* data, size_t size) {
    if (size > text_.size() - at_) throw std::length_error("short");
    if (size > 0) std::memcpy(data, text_.data() + at_, size);  // an empty vector's data may be null
    at_ += size;
  }
  template <class T>
  void value(T& v) {
    bytes(&v, sizeof v);
  }
  void value(std::string& text) {
    text.resize(size_t(count(1)));
    bytes(text.data(), text.size());
  }
  template <class T>
  void array(std::vector<T>& all) {
    if constexpr (!std::is_same_v<T, std::string>) {
      all.resize(size_t(count(sizeof(T))));
      bytes(all.data(), all.size() * sizeof(T));
    } else {
      all.resize(size_t(count(sizeof(std::uint64_t))));
      for (T& each : all) value(each);
    }
  }
  std::uint64_t read_so_far() const { return at_; }

 private:
  // A damaged count must not become a request for memory.
  std::uint64_t count(size_t each) {
    std::uint64_t n = 0;
    value(n);
    if (n > (text_.size() - at_) / each) throw std::length_error("short");
    return n;
  }

  const std::string& text_;
  std::uint64_t at_ = 0;
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
  s.array(c.film.pixels);
  s.array(c.film.layers);
  s.value(c.course.samples);
  s.value(c.course.barrier);
  s.array(c.course.targets);
  s.array(c.course.past);
  s.value(c.course.promise);
  s.value(c.course.promised_for);
  s.value(c.course.seconds);
  s.value(c.course.cpu_seconds);
  s.value(c.course.rays.camera);
  s.value(c.course.rays.shadow);
  s.value(c.course.rays.bounce);
  s.value(c.course.rays.non_finite);
}

[[noreturn]] void damaged(const std::filesystem::path& path, const std::string& what) {
  throw InputError(fmt::format("{} {}", shown_name(path.string()), what),
                   "a checkpoint is what sateen render --checkpoint writes, and a render that a signal stopped",
                   InputError::Kind::unreadable);
}

}  // namespace

void write_checkpoint(const std::filesystem::path& path, const Checkpoint& c) {
  write_file_whole(path, [&](const std::filesystem::path& temporary) {
    std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
    Writer writer(out);
    writer.value(magic);
    writer.value(std::uint64_t(c.facts.size()));
    for (const Fact& fact : c.facts) {
      writer.value(fact.name);
      writer.value(fact.value);
      writer.value(fact.shown);
    }
    exchange(writer, c);
    const std::uint64_t hash = writer.hash();
    writer.value(hash);
    out.close();
    if (!out) throw OperationError(fmt::format("{} cannot be written", path.string()));
  });
}

Checkpoint read_checkpoint(const std::filesystem::path& path) {
  const std::string text = read_text_file(path, largest_file);
  Checkpoint c;
  Reader reader(text);
  try {
    char found[sizeof magic];
    reader.value(found);
    if (std::memcmp(found, magic, sizeof magic) != 0) damaged(path, "is no checkpoint, or one of another version");
    std::uint64_t facts = 0;
    reader.value(facts);
    if (facts > 1000) throw std::length_error("facts");
    c.facts.resize(size_t(facts));
    for (Fact& fact : c.facts) {
      reader.value(fact.name);
      reader.value(fact.value);
      reader.value(fact.shown);
    }
    exchange(reader, c);
    const std::uint64_t expected = Hash().add_bytes(text.data(), size_t(reader.read_so_far())).value;
    std::uint64_t hash = 0;
    reader.value(hash);
    const size_t pixels = c.film.pixels.size();
    const bool sizes = c.film.width > 0 && c.film.height > 0 &&
                       pixels == size_t(c.film.width) * size_t(c.film.height) &&
                       (c.film.layers.empty() || c.film.layers.size() == pixels) && c.course.targets.size() == pixels;
    if (hash != expected || !sizes) throw std::length_error("hash");
  } catch (const std::length_error&) {
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
    sum.course.rays.camera += c.course.rays.camera;
    sum.course.rays.shadow += c.course.rays.shadow;
    sum.course.rays.bounce += c.course.rays.bounce;
    sum.course.rays.non_finite += c.course.rays.non_finite;
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
