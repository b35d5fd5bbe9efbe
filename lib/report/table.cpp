#include "report/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sateen {

namespace {
bool is_number(const std::string& cell) {
  const size_t first = !cell.empty() && (cell[0] == '-' || cell[0] == '+') ? 1 : 0;
  return cell == "-" || (cell.size() > first && cell[first] >= '0' && cell[first] <= '9');
}

// A column stands to the right where all of its cells are numbers.
std::vector<bool> number_columns(const Table& table) {
  std::vector<bool> all(table.head.size(), !table.rows.empty());
  for (const auto& row : table.rows)
    for (size_t i = 0; i < all.size(); ++i)
      if (i < row.size() && !row[i].empty() && !is_number(row[i])) all[i] = false;
  return all;
}

size_t letters(const std::string& text) {
  return size_t(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
}
}  // namespace

std::string table_text(const Table& table) {
  std::vector<size_t> widths;
  for (const std::string& name : table.head) widths.push_back(letters(name));
  for (const auto& row : table.rows)
    for (size_t i = 0; i < std::min(row.size(), widths.size()); ++i) widths[i] = std::max(widths[i], letters(row[i]));
  const std::vector<bool> right = number_columns(table);
  std::string text;
  const auto put = [&](const std::vector<std::string>& row) {
    std::string line;
    for (size_t i = 0; i < widths.size(); ++i) {
      const std::string cell = i < row.size() ? row[i] : "";
      const std::string space(widths[i] - letters(cell), ' ');
      line += (i > 0 ? "  " : "") + (right[i] ? space + cell : cell + space);
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  put(table.head);
  for (const auto& row : table.rows) put(row);
  return text;
}

std::string table_csv(const Table& table) {
  std::string text;
  const auto put = [&](const std::vector<std::string>& row) {
    for (size_t i = 0; i < row.size(); ++i) {
      std::string cell = row[i];
      if (cell.find_first_of(",\"\n\r") != std::string::npos) {
        for (size_t at = cell.find('"'); at != std::string::npos; at = cell.find('"', at + 2)) cell.insert(at, "\"");
        cell = "\"" + cell + "\"";
      }
      text += (i > 0 ? "," : "") + cell;
    }
    text += "\n";
  };
  put(table.head);
  for (const auto& row : table.rows) put(row);
  return text;
}

std::string table_html(const Table& table) {
  const std::vector<bool> right = number_columns(table);
  std::string text = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (size_t i = 0; i < table.head.size(); ++i)
    text += fmt::format("<th{}>{}</th>", right[i] ? " class=\"number\"" : "", html_text(table.head[i]));
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    text += "<tr>";
    for (size_t i = 0; i < row.size(); ++i) {
      std::string kind = i < right.size() && right[i] ? "number" : "";
      if (row[i] == "holds") kind = "holds";
      if (row[i] == "does not hold") kind = "fails";
      text += (kind.empty() ? "<td>" : "<td class=\"" + kind + "\">") + html_text(row[i]) + "</td>";
    }
    text += "</tr>\n";
  }
  return text + "</tbody></table></div>\n";
}

std::string html_text(const std::string& text) {
  std::string out;
  for (const char c : text)
    out += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return out;
}

std::string number_text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}g}", value, digits) : std::string("-");
}

}  // namespace sateen
