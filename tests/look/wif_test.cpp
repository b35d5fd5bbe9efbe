#include "look/wif.h"

#include "look/describe.h"
#include "look_text.h"

namespace sateen {
namespace {

using Rows = std::vector<std::string>;

const char* const twill_wif =
    "; a comment\n[WIF]\r\nVersion=1.1\n[WEAVING]\nRising Shed=yes\nShafts=4\n[WARP]\nThreads=8\n"
    "[WEFT]\nThreads=4\n[THREADING]\n1=1\n2=2\n3=3\n4=4\n5=1\n6=2\n7=3\n8=4\n"
    "[TIEUP]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n[TREADLING]\n1=1\n2=2\n3=3\n4=4\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  return at == std::string::npos ? text + "(not there)" : text.replace(at, from.size(), to);
}

TEST(Wif, IsReadByTieupAndTreadlingOrByLiftplan) {
  const Rows twill{"x..x", "xx..", ".xx.", "..xx"};  // thread 1 on the right, pick 1 at the bottom
  EXPECT_EQ(draft_rows(parse_wif(twill_wif, "a.wif").draft), twill);
  std::string lifts = twill_wif;
  lifts.resize(lifts.find("[TIEUP]"));
  EXPECT_EQ(draft_rows(parse_wif(lifts + "[LIFTPLAN]\n1=1,2\n2=2, 3\n3=3,4\n4=1,4\n", "a.wif").draft), twill);
  const Rows sinking{".xx.", "..xx", "x..x", "xx.."};
  EXPECT_EQ(draft_rows(parse_wif(replaced(twill_wif, "Shed=yes", "Shed=no"), "a.wif").draft), sinking);
}

TEST(Wif, FaultsAreToldWithTheirLines) {
  const auto error = [](const std::string& text) { return error_of([&] { parse_wif(text, "a.wif"); }); };
  EXPECT_NE(error("hello").find("a.wif:1:1: error: stands before the first section"), std::string::npos)
      << error("hello");
  EXPECT_NE(error("[TEXT]\n").find("no section [WIF]"), std::string::npos);
  EXPECT_NE(error(replaced(twill_wif, "3=3\n", "3=x\n")).find("a.wif:14:3: error: the number in the list is x"),
            std::string::npos)
      << error(replaced(twill_wif, "3=3\n", "3=x\n"));
  EXPECT_NE(error(replaced(twill_wif, "3=3\n", "3 3\n")).find("a.wif:14:1: error: has no ="), std::string::npos);
  EXPECT_NE(error(replaced(twill_wif, "8=4", "0=4")).find("counted from 1"), std::string::npos);
  EXPECT_NE(error(replaced(twill_wif, "8=4", "99999=4")).find("expected a whole number from 0 to 8192"),
            std::string::npos);
  EXPECT_NE(error("[WIF]\n").find("there is no section [THREADING]"), std::string::npos);
}

TEST(Wif, RefusesOrUnderstandsWhateverItIsGiven) {
  std::uint64_t state = 11;
  const auto below = [&](size_t n) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return size_t(state >> 33) % n;
  };
  int understood = 0;
  constexpr int count = 20000;
  const std::string pieces[] = {"[",  "]",   "=", "\n", ",", "1=1,2,3", "[LIFTPLAN]\n", ";", "999999999999",
                                "-1", "\xff"};
  for (int i = 0; i < count; ++i) {
    std::string text = twill_wif;
    for (size_t edits = 1 + below(3); edits > 0; --edits) {
      const size_t at = below(text.size());
      if (below(2))
        text.insert(at, pieces[below(std::size(pieces))]);
      else
        text.erase(at, 1 + below(6));
    }
    try {
      const Draft draft = parse_wif(text, "a.wif").draft;
      ASSERT_EQ(draft.warp_up.size(), size_t(draft.ends) * size_t(draft.picks));
      ASSERT_GT(draft.warp_up.size(), 0u);
      ++understood;
    } catch (const InputError& error) {
      ASSERT_FALSE(error.diagnostics.empty());
    }
  }
  EXPECT_GT(understood, count / 50);
}

TEST(Wif, BesideALookTakesThePlaceOfItsDraft) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("twill.wif", twill_wif);
  const std::string path = folder.write("a.json", "{\"weave\": {\"draft\": \"twill.wif\"}}");
  const Look look = read_look(path);
  EXPECT_EQ(look.weave.draft, (Rows{"x..x", "xx..", ".xx.", "..xx"}));
  EXPECT_EQ(look_hash(parse_look(write_look(look), "b.json")), look_hash(look));
  const std::string missing = folder.write("b.json", "{\"weave\": {\n\"draft\": \"twil.wif\"}}");
  EXPECT_NE(error_of([&] { read_look(missing); }).find("b.json:2:10: error: twil.wif: no such file"),
            std::string::npos)
      << error_of([&] { read_look(missing); });
  folder.write("twil.wif", "[WIF]\n[THREADING]\n1=1\n[LIFTPLAN]\nnonsense\n");
  EXPECT_NE(error_of([&] { read_look(missing); }).find("twil.wif:5:1: error: has no ="), std::string::npos)
      << error_of([&] { read_look(missing); });
  Look set;
  apply_overrides(set, {"weave.draft=" + folder.file("twill.wif")});
  EXPECT_EQ(set.weave.draft.size(), 4u);
}

const Rows twill_rows{"x..x", "xx..", ".xx.", "..xx"};

/// The rows of a WIF text; its warnings go to `warnings`.
Rows rows_of(const std::string& text, std::vector<std::string>* warnings = nullptr) {
  WifDraft read = parse_wif(text, "a.wif");
  if (warnings) *warnings = read.warnings;
  return draft_rows(read.draft);
}

std::string wif_error(const std::string& text) {
  return error_of([&] { parse_wif(text, "a.wif"); });
}

void expect_told(const std::vector<std::string>& warnings, const std::string& part) {
  for (const std::string& warning : warnings)
    if (warning.find(part) != std::string::npos) return;
  std::string all;
  for (const std::string& warning : warnings) all += "\n" + warning;
  ADD_FAILURE() << "nothing says \"" << part << "\":" << all;
}

std::string with_line_ends(std::string text, const std::string& end) {
  std::string out;
  for (const char c : text) {
    if (c == '\n')
      out += end;
    else if (c != '\r')
      out += c;
  }
  return out;
}

TEST(Wif, LineEndsOfEverySystemAndAByteOrderMarkAreRead) {
  for (const char* end : {"\n", "\r\n", "\r"}) EXPECT_EQ(rows_of(with_line_ends(twill_wif, end)), twill_rows);
  EXPECT_EQ(rows_of(std::string("\xef\xbb\xbf") + twill_wif), twill_rows);
  EXPECT_NE(wif_error(with_line_ends(replaced(twill_wif, "3=3\n", "3=x\n"), "\r")).find("a.wif:14:3: error:"),
            std::string::npos);
}

TEST(Wif, TextInSixteenBitsIsNamed) {
  std::string wide;
  for (const char* at = twill_wif; *at; ++at) wide += {*at, '\0'};
  EXPECT_NE(wif_error("\xff\xfe" + wide).find("is UTF-16 text, expected UTF-8"), std::string::npos);
  EXPECT_NE(wif_error("\xfe\xff").find("is UTF-16 text"), std::string::npos);
  EXPECT_NE(wif_error(wide).find("is UTF-16 text, or no text at all"), std::string::npos);
  EXPECT_NE(wif_error(twill_wif + std::string(1, '\0')).find("holds a zero byte"), std::string::npos);
}

TEST(Wif, WhatItDoesNotUseMayHoldAnyText) {
  const std::string notes = "[NOTES]\n1=A waffle\nWash hot before you cut\n[see page 3\n= \xff\n[PRIVATE X]\n9=9,x\n";
  EXPECT_EQ(rows_of(twill_wif + notes), twill_rows);
  EXPECT_EQ(rows_of("garbage before it all\n" + std::string(twill_wif)), twill_rows);
}

TEST(Wif, CommentsMayStandAnywhere) {
  std::string text = twill_wif;
  for (const auto& [from, to] :
       std::vector<std::pair<std::string, std::string>>{{"[WARP]", "[WARP] ; of wool"},
                                                        {"Threads=8", "Threads=8 ; ends"},
                                                        {"Shed=yes", "Shed=yes; a rising shed"},
                                                        {"[TIEUP]", "# here the ties\n  ; and more\n[TIEUP]\t# yes"},
                                                        {"1=1,2", "1=1,2 # both"}})
    text = replaced(text, from, to);
  EXPECT_EQ(rows_of(text), twill_rows);
}

TEST(Wif, ListsMayBeSeparatedByBlanks) {
  std::string text = replaced(twill_wif, "1=1,2", "1=1 2");
  text = replaced(text, "2=2,3", "2 = 2\t, 3 ");
  EXPECT_EQ(rows_of(text), twill_rows);
}

TEST(Wif, AnEmptyOrDeniedLiftplanGivesWayToTheTreadles) {
  const std::string stale = "[LIFTPLAN]\n1=1\n2=1\n3=1\n4=1\n";
  EXPECT_EQ(rows_of(twill_wif + std::string("[LIFTPLAN]\n")), twill_rows);
  EXPECT_EQ(rows_of(twill_wif + std::string("[LIFTPLAN]\n1=\n2=0\n")), twill_rows);
  EXPECT_EQ(rows_of(twill_wif + ("[CONTENTS]\nLIFTPLAN=false ; stale\n" + stale)), twill_rows);
  std::vector<std::string> warnings;
  EXPECT_EQ(rows_of(twill_wif + ("[CONTENTS]\nTREADLING=true\nTIEUP=1\n" + stale), &warnings), twill_rows);
  expect_told(warnings, "LIFTPLAN, which it does not name, is not used");
  EXPECT_EQ(rows_of(twill_wif + stale, &warnings), (Rows{"...x"}));
  expect_told(warnings, "LIFTPLAN and TREADLING with TIEUP draw different cloths; LIFTPLAN is used");
  rows_of(twill_wif + std::string("[LIFTPLAN]\n1=1,2\n2=2,3\n3=3,4\n4=4,1\n"), &warnings);
  EXPECT_TRUE(warnings.empty());  // the same cloth said twice
}

TEST(Wif, SectionsThatItsContentsDenyAreNotUsed) {
  EXPECT_EQ(rows_of(replaced(twill_wif, "Shed=yes", "Shed=no") + "[CONTENTS]\nWEAVING=false\n"), twill_rows);
  EXPECT_NE(wif_error(twill_wif + std::string("[CONTENTS]\nTHREADING=no\n"))
                .find("[CONTENTS] says that THREADING is not used, and nothing else tells it"),
            std::string::npos);
}

TEST(Wif, AWordThatIsNeitherYesNorNoIsAnErrorWithTheWords) {
  EXPECT_NE(wif_error(replaced(twill_wif, "Shed=yes", "Shed=T"))
                .find("a.wif:5:13: error: Rising Shed is T, expected true, on, yes, 1, false, off, no or 0"),
            std::string::npos)
      << wif_error(replaced(twill_wif, "Shed=yes", "Shed=T"));
  EXPECT_NE(wif_error(twill_wif + std::string("[CONTENTS]\nTIEUP=maybe\n")).find("TIEUP is maybe, expected true"),
            std::string::npos);
  for (const char* word : {"On", "TRUE", "1", "yes"})
    EXPECT_EQ(rows_of(replaced(twill_wif, "Shed=yes", "Shed=" + std::string(word))), twill_rows);
  EXPECT_EQ(rows_of(replaced(twill_wif, "Shed=yes", "Shed=")), twill_rows);  // empty: the default
}

TEST(Wif, ThreadsThatAreNotDrawnAreLeftOutWithAWord) {
  std::vector<std::string> warnings;
  std::string padded = replaced(replaced(twill_wif, "Threads=8", "Threads=1200"), "Threads=4", "Threads=1200");
  EXPECT_EQ(rows_of(padded, &warnings), twill_rows);
  expect_told(warnings, "of 1200 ends only 1 to 8 are on a shaft: the others are left out");
  expect_told(warnings, "of 1200 picks only 1 to 4 lift a shaft: the others are left out");
  EXPECT_EQ(rows_of(replaced(twill_wif, "Threads=8", "Threads=3"), &warnings), twill_rows);
  expect_told(warnings, "a.wif:8: [WARP] says 3 threads, but 8 are written, which count");
  rows_of(replaced(twill_wif, "3=3\n4=4\n5=1", "3=0\n4=4\n5=1"), &warnings);
  expect_told(warnings, "1 of the 8 ends are on no shaft");
}

TEST(Wif, ATreadleThatIsNotTiedIsNamed) {
  std::vector<std::string> warnings;
  std::string text = twill_wif;
  text.replace(text.rfind("3=3"), 3, "3=7");
  rows_of(text, &warnings);
  expect_told(warnings, "treadle 7, first used by pick 3, is tied to no shaft: it lifts nothing");
}

// The last pick of four that lifts nothing is a float of the weft, not padding.
TEST(Wif, AnIdlePickAtTheEndOfTheRepeatIsPartOfIt) {
  std::string text = twill_wif;
  text.replace(text.rfind("4=4"), 3, "4=7");
  Rows rows = rows_of(text);
  EXPECT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows.front(), "....");
}

TEST(Wif, CountingFromZeroIsReadWhereItCanBeToldFromNoShaft) {
  const std::string head = "[WIF]\n[WEAVING]\nShafts=3\n[THREADING]\n0=";
  const std::string lifts = "[LIFTPLAN]\n0=0,1\n1=1,2\n2=2,0\n";
  const Rows one_based = rows_of("[WIF]\n[THREADING]\n1=1\n2=2\n3=3\n[LIFTPLAN]\n1=1,2\n2=2,3\n3=3,1\n");
  std::vector<std::string> warnings;
  EXPECT_EQ(rows_of(head + "0\n1=1\n2=2\n" + lifts, &warnings), one_based);
  expect_told(warnings, "[THREADING] counts from 0");
  EXPECT_NE(wif_error(head + "0\n1=1\n2=3\n" + lifts).find("whether shaft 0 is the first or none cannot be told"),
            std::string::npos);
}

TEST(Wif, ColoursOfThreadsAreToldAsNotYetUsed) {
  std::vector<std::string> warnings;
  const std::string colors = "[COLOR TABLE]\n1=255,0,0\n2=0,0,0\n[WARP COLORS]\n1=2\n[WEFT COLORS]\n1=1\n";
  EXPECT_EQ(rows_of(twill_wif + colors, &warnings), twill_rows);
  expect_told(warnings, "(COLOR TABLE, WARP COLORS, WEFT COLORS) are not used yet");
  rows_of(twill_wif, &warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(Wif, SizesAndSymbolsOfThreadsAreToldAsNotYetUsedInOneNote) {
  const auto only_warning = [](const std::string& text) {
    std::vector<std::string> warnings;
    EXPECT_EQ(rows_of(text, &warnings), twill_rows);
    EXPECT_EQ(warnings.size(), 1u) << text;
    return warnings.empty() ? "" : warnings[0];
  };
  const std::string warp = "[WARP]\n", weft = "[WEFT]\n";
  EXPECT_EQ(only_warning(replaced(replaced(twill_wif, warp, warp + "Units=centimeters\nSpacing=0.2\nThickness=.1\n"),
                                  weft, weft + "Spacing=0.4\n")),
            "a.wif: the spacing and thickness of its threads (Units of WARP, Spacing of WARP and WEFT, Thickness of "
            "WARP) are not used yet, those of the look are");
  EXPECT_EQ(only_warning(replaced(twill_wif, warp, warp + "Color=1\n")),
            "a.wif: the colours of its threads (Color of WARP) are not used yet, those of the look are");
  EXPECT_EQ(only_warning(twill_wif + std::string("[WARP SYMBOLS]\n1=#\n")),
            "a.wif: the symbols of its threads (WARP SYMBOLS) are not used yet");
  EXPECT_EQ(only_warning(twill_wif + std::string("[COLOR TABLE]\n1=1,1,1\n[WARP SPACING]\n1=.5\n[WEFT THICKNESS]\n"
                                                 "as it comes\n[WEFT SYMBOLS]\n1=x\n")),
            "a.wif: the colours of its threads (COLOR TABLE), the spacing and thickness of them (WARP SPACING, WEFT "
            "THICKNESS), the symbols of them (WEFT SYMBOLS) are not used yet, those of the look are");
  // Nothing is said where nothing is there, or where the contents deny it.
  std::vector<std::string> warnings;
  rows_of(twill_wif + std::string("[WARP SPACING]\n; none\n\n[WEFT SPACING]\n1=2\n[CONTENTS]\nWEFT SPACING=no\n"),
          &warnings);
  rows_of(replaced(twill_wif, warp, warp + "Spacing=\n"), &warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(Wif, TheEndOfTextThatDosWritesIsPassedOver) {
  const std::string end = "\x1a", text = twill_wif;
  for (const std::string& padded : {text + end, text + end + end + std::string(3, '\0'), text + end + "\r\n",
                                    replaced(text, "4=4,1\n", "4=4,1" + end + "\n" + end + "\n" + end)})
    EXPECT_EQ(rows_of(padded), twill_rows);
  EXPECT_NE(wif_error(replaced(text, "3=3\n", "3=3" + end + "4\n")).find("a.wif:14:3: error"), std::string::npos);
}

TEST(Wif, NumbersAtTheEdgeOfWhatIsCountedAreReadOrRefused) {
  // Counted from 0, shaft 4096 is the 4097th.
  const std::string from_zero =
      "[WIF]\n[WEAVING]\nShafts=3\n[THREADING]\n0=0\n1=1\n2=4096\n[LIFTPLAN]\n0=0\n1=1\n2=4096\n";
  EXPECT_EQ(rows_of(from_zero), (Rows{"x..", ".x.", "..x"}));
  EXPECT_EQ(rows_of("[WIF]\n[THREADING]\n0=1\n1=2\n[TIEUP]\n0=1\n4096=2\n[TREADLING]\n0=4096\n1=0\n"),
            (Rows{".x", "x."}));
  for (const char* number : {"4097", "2147483647", "2147483648", "4294967297", "-1", "-2147483648",
                             "-9223372036854775808", "18446744073709551616"})
    for (const char* line : {"3=3\n", "2=2,3\n", "Threads=8\n"}) {
      const std::string key(line, std::string(line).find('=') + 1), changed = key + number + "\n";
      if (key == "Threads=" && std::string(number) == "4097") continue;  // as many may be told
      EXPECT_NE(wif_error(replaced(twill_wif, line, changed)).find("expected a whole number from 0 to"),
                std::string::npos)
          << changed;
    }
}

TEST(Wif, ContradictionsAreFaults) {
  EXPECT_NE(wif_error(twill_wif + std::string("[THREADING]\n1=2\n")).find("there are two sections [THREADING]"),
            std::string::npos);
  EXPECT_NE(wif_error(replaced(twill_wif, "8=4", "7=4")).find("7 is given twice, first in line"), std::string::npos);
  EXPECT_EQ(rows_of(replaced(twill_wif, "8=4", "8=4\n8=4")), twill_rows);
  EXPECT_NE(wif_error("[WIF]\n[THREADING]\n1=\n[LIFTPLAN]\n1=1\n").find("no end of [THREADING] is on a shaft"),
            std::string::npos);
  EXPECT_NE(wif_error("[WIF]\n[THREADING]\n1=1\n[LIFTPLAN]\n1=\n").find("no pick of [LIFTPLAN] lifts a shaft"),
            std::string::npos);
  EXPECT_NE(
      wif_error("[WIF]\n[THREADING]\n1=1\n[TREADLNG]\n1=1\n[TIEUP]\n1=1\n").find("there is a section [TREADLNG]"),
      std::string::npos);
}

TEST(Wif, AJacquardOf4096EndsAndPicksIsReadAndOneMoreIsRefused) {
  const auto jacquard = [](int ends, int picks) {
    std::string text = "[WIF]\n[THREADING]\n";
    for (int end = 1; end <= ends; ++end) text += std::to_string(end) + "=" + std::to_string(end % 61 + 1) + "\n";
    text += "[LIFTPLAN]\n";
    for (int pick = 1; pick <= picks; ++pick)
      text += std::to_string(pick) + "=" + std::to_string(pick % 61 + 1) + "," +
              std::to_string(pick * pick % 59 + 1) + "\n";
    return text;
  };
  const Draft draft = parse_wif(jacquard(4096, 4096), "a.wif").draft;
  EXPECT_EQ(draft.ends, 4096);
  EXPECT_EQ(draft.picks, 4096);
  EXPECT_NE(wif_error(jacquard(4097, 4096)).find("repeats over 4097 ends and 4096 picks, expected at most 4096"),
            std::string::npos);
}

TEST(Wif, ItsWarningsTravelWithTheLookAndGoWithItsDraft) {
  use_source_tree();
  const ScratchFolder folder;
  folder.write("twill.wif", replaced(twill_wif, "Threads=8", "Threads=12"));
  const std::string path = folder.write("a.json", "{\"weave\": {\"draft\": \"twill.wif\"}}");
  EXPECT_EQ(read_look(path).weave.draft_warnings.size(), 1u);
  EXPECT_TRUE(read_look(path, {"weave.draft=plain"}).weave.draft_warnings.empty());
  const std::string missing = folder.write("b.json", "{\"weave\": {\"draft\": \"none.wif\"}}");
  try {
    read_look(missing);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_EQ(error.kind, InputError::Kind::unreadable);
  }
}

}  // namespace
}  // namespace sateen
