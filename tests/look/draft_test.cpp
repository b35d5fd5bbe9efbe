#include "look/draft.h"

#include <numeric>

#include "look/describe.h"
#include "look/wif.h"
#include "look_text.h"

namespace sateen {
namespace {

using Rows = std::vector<std::string>;

Rows rows_of(const std::string& text) {
  return draft_rows(parse_draft({text}));
}

TEST(Draft, DrawsTheNamedWeavesAsWeaversDo) {
  EXPECT_EQ(rows_of("plain"), (Rows{"x.", ".x"}));
  // Diagonals of warp rise to the right.
  EXPECT_EQ(rows_of("twill 2/1"), (Rows{"xx.", "x.x", ".xx"}));
  EXPECT_EQ(rows_of("twill 2/1 z"), rows_of("Twill 2/1"));
  EXPECT_EQ(rows_of("twill 1/2 s"), (Rows{"x..", ".x.", "..x"}));
  EXPECT_EQ(rows_of("satin 5/2"), (Rows{".xxxx", "xx.xx", "xxxx.", "x.xxx", "xxx.x"}));
  EXPECT_EQ(rows_of("satin 5 counter 2"), rows_of("satin 5/2"));
  EXPECT_EQ(rows_of("sateen 5/2"), (Rows{"x....", "..x..", "....x", ".x...", "...x."}));
}

TEST(Draft, OfASatinLiftsEveryEndOverAllPicksButOne) {
  for (int n = 5; n <= 24; ++n)
    for (int c = 2; c < n - 1; ++c) {
      if (std::gcd(n, c) != 1) continue;
      const Draft draft = parse_draft({"satin " + std::to_string(n) + "/" + std::to_string(c)});
      for (int end = 0; end < n; ++end) {
        int up = 0;
        for (int pick = 0; pick < n; ++pick) up += draft.up(end, pick);
        EXPECT_EQ(up, n - 1);
      }
    }
}

TEST(Draft, ReadsAMatrixOfEitherKindOfSign) {
  EXPECT_EQ(draft_rows(parse_draft({"110", "0X1"})), (Rows{"xx.", ".xx"}));
  EXPECT_EQ(draft_rows(parse_draft({"x."})), (Rows{"x."}));
}

TEST(Draft, SaysWhatIsWrongAndWhatWouldBeRight) {
  const auto error = [](const Rows& text) { return error_of([&] { parse_draft(text); }); };
  EXPECT_NE(error({"sattin 5/2"}).find("did you mean satin?"), std::string::npos) << error({"sattin 5/2"});
  EXPECT_NE(error({"satin 8/2"}).find("for 8 ends: 3, 5"), std::string::npos) << error({"satin 8/2"});
  EXPECT_NE(error({"satin 5/4"}).find("for 5 ends: 2, 3"), std::string::npos);
  EXPECT_NE(error({"satin 6/5"}).find("6 ends"), std::string::npos);
  EXPECT_NE(error({"twill 3"}).find("twill n/m"), std::string::npos);
  EXPECT_NE(error({"twill 3/1 q"}).find("twill n/m"), std::string::npos);
  EXPECT_NE(error({"twill 600/1"}).find("at most 512"), std::string::npos);
  EXPECT_NE(error({"x.x", ".x"}).find("row 2 of the draft has 2 crossings, expected 3 as the first"),
            std::string::npos);
  EXPECT_NE(error({"x.x", ".yx"}).find("row 2 of the draft holds y"), std::string::npos);
  EXPECT_NE(error({"", "x"}).find("there is no draft"), std::string::npos);
  EXPECT_NE(error({std::string(600, 'x')}).find("at most 512"), std::string::npos);
}

TEST(Draft, IsReducedToItsSmallestRepeat) {
  const Draft twice = parse_draft({"x.x.x.", ".x.x.x", "x.x.x.", ".x.x.x"});
  EXPECT_EQ(draft_rows(smallest_repeat(twice)), rows_of("plain"));
  EXPECT_EQ(draft_rows(smallest_repeat(parse_draft({"satin 8/3"}))), rows_of("satin 8/3"));
}

TEST(Draft, OfALookIsReadWrittenInheritedAndChecked) {
  use_source_tree();
  const Look named = parse_look("{\"weave\": {\"draft\": \"satin 5/2\", \"warp_per_cm\": 80}}", "a.json");
  EXPECT_EQ(named.weave.draft, Rows{"satin 5/2"});
  EXPECT_EQ(named.weave.warp_per_cm, 80);
  const Look drawn = parse_look("{\"weave\": {\"draft\": [\"x.\", \".x\"]}}", "a.json");
  EXPECT_EQ(parse_look(write_look(drawn), "a.json").weave.draft, (Rows{"x.", ".x"}));
  EXPECT_EQ(write_look(Look()).find("weave"), std::string::npos);
  EXPECT_NE(error_in("{\"weave\": {\n  \"draft\": \"satin 8/4\"}}").find("silk.json:2:12: error: the satin over 8"),
            std::string::npos)
      << error_in("{\"weave\": {\n  \"draft\": \"satin 8/4\"}}");
  EXPECT_NE(error_in("{\"weave\": {\"draft\": [1, 2]}}").find("draft is a list of 2"), std::string::npos);
  EXPECT_NE(error_in("{\"weave\": {\"darft\": \"plain\"}}").find("did you mean draft?"), std::string::npos);
  EXPECT_NE(error_in("{\"draft\": \"plain\"}").find("it belongs inside \"weave\""), std::string::npos)
      << error_in("{\"draft\": \"plain\"}");
  Look look;
  apply_overrides(look, {"weave.draft=twill 3/1", "weave.slubs=.5"});
  EXPECT_EQ(look.weave.draft, Rows{"twill 3/1"});
  apply_overrides(look, {"weave.draft=[\"x.\",\".x\"]"});
  EXPECT_EQ(look.weave.draft.size(), 2u);
  apply_overrides(look, {"weave.draft="});
  EXPECT_TRUE(look.weave.draft.empty());
}

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
  EXPECT_EQ(draft_rows(parse_wif(twill_wif, "a.wif")), twill);
  std::string lifts = twill_wif;
  lifts.resize(lifts.find("[TIEUP]"));
  EXPECT_EQ(draft_rows(parse_wif(lifts + "[LIFTPLAN]\n1=1,2\n2=2, 3\n3=3,4\n4=1,4\n", "a.wif")), twill);
  const Rows sinking{".xx.", "..xx", "x..x", "xx.."};
  EXPECT_EQ(draft_rows(parse_wif(replaced(twill_wif, "Shed=yes", "Shed=no"), "a.wif")), sinking);
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
  EXPECT_NE(error(replaced(twill_wif, "8=4", "9=4")).find("[WARP] has 8 threads, but thread 9 is used"),
            std::string::npos);
  EXPECT_NE(error(replaced(twill_wif, "8=4", "0=4")).find("counted from 1"), std::string::npos);
  EXPECT_NE(error(replaced(twill_wif, "8=4", "99999=4")).find("expected a whole number from 0 to 2048"),
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
      const Draft draft = parse_wif(text, "a.wif");
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

}  // namespace
}  // namespace sateen
