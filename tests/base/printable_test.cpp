#include "base/printable.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace sateen {
namespace {

TEST(Printable, KeepsLettersOfEveryScriptAndSymbols) {
  const std::string text = "Köper 緞子 ساتين \xf0\x9f\xa7\xb5 \\ \"";
  EXPECT_EQ(printable(text), text);
}

TEST(Printable, EscapesWhatATerminalWouldObey) {
  EXPECT_EQ(printable("\x1b]0;x\a\x7f"), "\\x1b]0;x\\x07\\x7f");
  EXPECT_EQ(printable("a\nb\rc\td"), "a\\nb\\rc\\td");
  EXPECT_EQ(printable("a\nb\rc\td", true, true), "a\nb\\rc\td");
  EXPECT_EQ(printable("\xc2\x9b[2J\xc2\x85"), "\\u009b[2J\\u0085");  // C1
  EXPECT_EQ(printable("\xe2\x80\xae"
                      "evil\xe2\x81\xa9"),
            "\\u202eevil\\u2069");
  EXPECT_EQ(printable(std::string(1, '\0')), "\\x00");
}

TEST(Printable, ShowsBytesThatAreNoUtf8AsHexadecimal) {
  EXPECT_EQ(printable("\xff\x9b[2J\xc3"), "\\xff\\x9b[2J\\xc3");
  EXPECT_EQ(printable("\xc0\xaf\xed\xa0\x80"), "\\xc0\\xaf\\xed\\xa0\\x80");
}

TEST(Diagnostic, NoPartOfItReachesATerminalAsAControlSequence) {
  Diagnostic d;
  d.file = "a\x1b[2J\n.json";
  d.line = 1;
  d.column = 5;
  d.width = 2;
  d.source_line = "\x1b[1mxy\xe2\x80\xae";
  d.message = "found \x9b";
  d.help = "see \x1b[0m";
  EXPECT_EQ(to_string(d),
            "a\\x1b[2J\\n.json:1:5: error: found \\x9b\n    1 | \\x1b[1mxy\\u202e\n      |        ^^\n"
            "  help: see \\x1b[0m");
}

}  // namespace
}  // namespace sateen
