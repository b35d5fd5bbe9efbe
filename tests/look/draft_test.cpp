#include "look/draft.h"

#include <cstdint>
#include <numeric>

#include "look/describe.h"
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
  EXPECT_NE(error({"twill 4096/1"}).find("at most 4096"), std::string::npos);
  EXPECT_NE(error({"x.x", ".x"}).find("row 2 of the draft has 2 crossings, expected 3 as the first"),
            std::string::npos);
  EXPECT_NE(error({"x.x", ".yx"}).find("row 2 of the draft holds y"), std::string::npos);
  EXPECT_NE(error({"", "x"}).find("there is no draft"), std::string::npos);
  EXPECT_NE(error({std::string(4097, 'x')}).find("at most 4096"), std::string::npos);
}

TEST(Draft, IsReducedToItsSmallestRepeat) {
  const Draft twice = parse_draft({"x.x.x.", ".x.x.x", "x.x.x.", ".x.x.x"});
  EXPECT_EQ(draft_rows(smallest_repeat(twice)), rows_of("plain"));
  EXPECT_EQ(draft_rows(smallest_repeat(parse_draft({"satin 8/3"}))), rows_of("satin 8/3"));
}

TEST(Draft, OfManyCrossingsIsPackedAndReadsBackTheSame) {
  Draft large{1030, 1021, {}};
  std::uint32_t state = 5;
  for (int i = 0; i < large.ends * large.picks; ++i)
    large.warp_up.push_back(std::uint8_t((state = state * 1664525u + 1013904223u) >> 31));
  const Rows rows = draft_rows(large);
  EXPECT_EQ(rows.size(), 1022u);
  EXPECT_EQ(rows[0], "packed 1030");
  const Draft again = parse_draft(rows);
  EXPECT_EQ(again.ends, large.ends);
  EXPECT_EQ(again.picks, large.picks);
  EXPECT_EQ(again.warp_up, large.warp_up);
  EXPECT_EQ(draft_rows(parse_draft({"packed 5", "a8", "50"})), (Rows{"x.x.x", ".x.x."}));
  const auto error = [](const Rows& text) { return error_of([&] { parse_draft(text); }); };
  EXPECT_NE(error({"packed 5", "a8", "5"}).find("row 2 of the draft is 5, expected 2 hexadecimal digits for 5 ends"),
            std::string::npos);
  EXPECT_NE(error({"packed 5", "ag"}).find("row 1"), std::string::npos);
  EXPECT_NE(error({"packed 0", ""}).find("expected packed and a number of ends"), std::string::npos);
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

}  // namespace
}  // namespace sateen
