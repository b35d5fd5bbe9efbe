#include "base/error.h"

#include <gtest/gtest.h>

namespace sateen {
namespace {

Diagnostic at(int line, int column, int width, const std::string& source) {
  Diagnostic d;
  d.file = "looks/silk.json";
  d.line = line;
  d.column = column;
  d.width = width;
  d.message = "gamma_s_deg is 170, expected 0.5 to 90";
  d.source_line = source;
  return d;
}

TEST(Diagnostic, ReadsAsTheDesignShowsIt) {
  Diagnostic d = at(14, 31, 3, "    \"warp\": { \"gamma_s_deg\": 170 },");
  d.help = "did you mean 17?";
  EXPECT_EQ(to_string(d),
            "looks/silk.json:14:31: error: gamma_s_deg is 170, expected 0.5 to 90\n"
            "   14 |     \"warp\": { \"gamma_s_deg\": 170 },\n"
            "      |                               ^^^\n"
            "  help: did you mean 17?");
}

TEST(Diagnostic, ATabKeepsItsWidthAboveTheCaret) {
  EXPECT_EQ(to_string(at(2, 4, 1, "\ta\tb")),
            "looks/silk.json:2:4: error: gamma_s_deg is 170, expected 0.5 to 90\n    2 | \ta\tb\n      | \t \t^");
}

TEST(Diagnostic, CaretsStandUnderTheirPlaceAfterCharactersOfSeveralBytes) {
  // Two bytes each for the umlauts, three for the dash: the column counts bytes, the eye characters.
  const std::string source = "\"Sämtblüte — x\": 170";
  const int column = int(source.find("170")) + 1;
  const std::string text = to_string(at(1, column, 3, source));
  const std::string carets = text.substr(text.rfind('\n') + 1);
  EXPECT_EQ(carets, "      | " + std::string(17, ' ') + "^^^");
}

TEST(Diagnostic, CaretsDoNotRunPastTheLine) {
  const std::string text = to_string(at(1, 3, 50, "abcd"));
  EXPECT_EQ(text.substr(text.rfind('\n') + 1), "      |   ^^");
}

TEST(Diagnostic, APlaceBehindTheLineStillHasItsCaret) {
  const std::string text = to_string(at(1, 5, 1, "abcd"));
  EXPECT_EQ(text.substr(text.rfind('\n') + 1), "      |     ^");
}

TEST(Diagnostic, ALongLineIsCutAroundThePlace) {
  std::string source(10000, 'a');
  source[7000] = 'X';
  const std::string text = to_string(at(3, 7001, 1, source));
  EXPECT_LT(text.size(), 500u);
  const std::string shown = text.substr(text.find("3 | ") + 4, text.rfind('\n') - text.find("3 | ") - 4);
  const std::string carets = text.substr(text.rfind("| ") + 2);
  ASSERT_NE(shown.find('X'), std::string::npos);
  EXPECT_EQ(shown.find('X'), carets.find('^'));
}

TEST(Diagnostic, ABinaryFileHasAnOffsetAndNoLine) {
  Diagnostic d;
  d.file = "map.exr";
  d.offset = 1234;
  d.message = "the header ends too early";
  EXPECT_EQ(to_string(d), "map.exr: at byte 1234: error: the header ends too early");
}

TEST(Diagnostic, WithoutAFileOnlyTheMessageStands) {
  Diagnostic d;
  d.message = "unknown strategy 'tabel'";
  d.help = "did you mean table?";
  EXPECT_EQ(to_string(d), "error: unknown strategy 'tabel'\n  help: did you mean table?");
}

TEST(InputErrors, ShowAtMostTwentyAndSayHowManyMore) {
  std::vector<Diagnostic> all(25);
  for (size_t i = 0; i < all.size(); ++i) all[i].message = "fault " + std::to_string(i) + ".";
  const InputError error(InputError::Kind::unreadable, all);
  const std::string text = error.what();
  EXPECT_NE(text.find("fault 19."), std::string::npos);
  EXPECT_EQ(text.find("fault 20."), std::string::npos);
  EXPECT_NE(text.find("... and 5 more"), std::string::npos);
  EXPECT_EQ(error.kind, InputError::Kind::unreadable);
  EXPECT_EQ(error.diagnostics.size(), 25u);
  all.resize(20);
  EXPECT_EQ(std::string(InputError(InputError::Kind::wrong, all).what()).find("more"), std::string::npos);
}

TEST(InputErrors, OfOneMessageAreWrongInputUnlessSaidOtherwise) {
  const InputError error("colour is out of reach", "raise k_d");
  EXPECT_EQ(error.kind, InputError::Kind::wrong);
  EXPECT_STREQ(error.what(), "error: colour is out of reach\n  help: raise k_d");
}

}  // namespace
}  // namespace sateen
