#pragma once
#include <string>
#include <vector>

namespace sateen {

/// Rows of text under column heads, for a terminal, a spreadsheet or a page. Rows may be shorter than the head.
struct Table {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// Columns of even width, two spaces apart, numbers to the right; a line break ends every row.
std::string table_text(const Table& table);

/// RFC 4180 with plain line feeds: cells with a comma, a quote or a line break stand in quotes.
std::string table_csv(const Table& table);

/// A <table> element. Cells that read PASS or MISSED get a class of that name, numbers stand to the right.
std::string table_html(const Table& table);

/// Text with &, <, > and quotes written so that HTML shows them.
std::string html_text(const std::string& text);

/// `digits` significant digits in the shortest form: "0.0123", "12.4", "1.2e-05"; "-" for what is not finite.
std::string number_text(double value, int digits = 3);

}  // namespace sateen
