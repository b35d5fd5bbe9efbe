#include "hostile_case.h"

#include <cstdlib>
#include <sstream>
#include <stdexcept>

#include "program.h"

namespace sateen_test {

namespace {

[[noreturn]] void refuse(const std::string& what) {
  throw std::runtime_error(what);
}

/// What `text` means with its escapes, from `at` to its end or to an unescaped }.
std::string unescaped(const std::string& text, size_t& at) {
  std::string out;
  for (; at < text.size() && text[at] != '}'; ++at) {
    if (text[at] != '\\') {
      if (text[at] != '\n') out += text[at];
      continue;
    }
    const char kind = ++at < text.size() ? text[at] : '?';
    if (kind == 'x') {
      out += char(std::stoi(text.substr(at + 1, 2), nullptr, 16));
      at += 2;
    } else if (kind == '{') {
      const size_t star = text.find('*', at);
      const int times = std::stoi(text.substr(at + 1, star - at - 1));
      at = star + 1;
      const std::string part = unescaped(text, at);
      if (at == text.size()) refuse("\\{ without }");
      for (int i = 0; i < times; ++i) out += part;
    } else if (const std::string plain = "nrts\\}", meant = "\n\r\t \\}"; plain.find(kind) != std::string::npos) {
      out += meant[plain.find(kind)];
    } else {
      refuse(std::string("unknown escape \\") + kind);
    }
  }
  return out;
}

std::string unescaped(const std::string& text) {
  size_t at = 0;
  std::string out = unescaped(text, at);
  if (at < text.size()) refuse("} without \\{");
  return out;
}

void take_section(HostileCase& to, const std::string& heading, const std::string& body) {
  std::istringstream words(heading);
  std::string kind, name;
  words >> kind;
  const bool typed = kind == "run" || kind == "file" || kind == "bytes";
  if (typed) to.inputs += "=== " + heading + "\n" + body;
  if (kind == "run") {
    for (std::string word; words >> word;) to.run.push_back(unescaped(word));
  } else if (kind == "file" || kind == "bytes") {
    words >> name;
    to.files.emplace_back(unescaped(name), kind == "file" ? body : unescaped(body));
  } else if (kind == "exit") {
    words >> to.exit_code;
  } else if (kind == "out" || kind == "err") {
    (kind == "out" ? to.out : to.err) = body;
  } else {
    refuse("unknown section " + heading);
  }
}

}  // namespace

HostileCase read_hostile_case(const std::filesystem::path& path) {
  HostileCase read;
  read.name = path.stem().string();
  std::istringstream lines(read_text(path));
  std::string heading, body;
  try {
    for (std::string line; std::getline(lines, line);) {
      if (line.rfind("=== ", 0) != 0) {
        body += line + "\n";
        continue;
      }
      if (!heading.empty()) take_section(read, heading, body);
      heading = line.substr(4);
      body.clear();
    }
    if (!heading.empty()) take_section(read, heading, body);
    if (read.run.empty()) refuse("no section run");
  } catch (const std::exception& error) {
    refuse(path.string() + ": " + error.what());
  }
  return read;
}

std::string write_hostile_case(const HostileCase& of) {
  std::string text = of.inputs + "=== exit " + std::to_string(of.exit_code) + "\n";
  if (!of.out.empty()) text += "=== out\n" + of.out;
  if (!of.err.empty()) text += "=== err\n" + of.err;
  return text;
}

}  // namespace sateen_test
