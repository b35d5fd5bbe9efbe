#include "look_text.h"

namespace sateen {
namespace {

std::string fault(const std::vector<std::string>& overrides) {
  use_source_tree();
  return error_of([&] { read_look("linen_plain", overrides); });
}

TEST(Overrides, SetAnyKindOfFieldAndForgiveBracketsAndQuotes) {
  use_source_tree();
  Look look = read_look("linen_plain");
  apply_overrides(look, {"warp.gamma_s_deg=4", "weft.k_d = .25", "warp.offsets_deg=-9,+0,9", "warp.lengths=[1, 2]",
                         "title=My \"linen\"", "weft.color={\"value\": [0.1, .2, 0.3], \"space\": \"acescg\"}"});
  EXPECT_EQ(look.warp.gamma_s_deg, 4);
  EXPECT_EQ(look.weft.k_d, 0.25f);
  EXPECT_EQ(look.warp.offsets_deg, (std::vector<float>{-9, 0, 9}));
  EXPECT_EQ(look.warp.lengths, (std::vector<float>{1, 2}));
  EXPECT_EQ(look.title, "My \"linen\"");
  EXPECT_EQ(fault({"weft.color={\"value\": [0.1, 0.2, 0.3], \"space\": \"acescg\"}"}), "(no error)");
  apply_override(look, "color=.5,.25,1e-1");
  EXPECT_EQ(look.warp.color->value, Color(0.5f, 0.25f, 0.1f));
  EXPECT_EQ(look.weft.color->value, Color(0.5f, 0.25f, 0.1f));
  apply_override(look, "weft.A=1,2,3");
  EXPECT_FALSE(look.weft.color);
}

TEST(Overrides, RefuseWithTheTextThatWasTyped) {
  EXPECT_EQ(
      fault({"warp.gamma_s_deg=170"}),
      "--set warp.gamma_s_deg=170: error: warp.gamma_s_deg is 170, expected 0.5 to 90\n  help: did you mean 17?");
  EXPECT_EQ(
      fault({"warp.gama_s_deg=4"}),
      "--set warp.gama_s_deg=4: error: there is no field warp.gama_s_deg\n  help: did you mean warp.gamma_s_deg?");
  EXPECT_EQ(fault({"gamma_s=4"}),
            "--set gamma_s=4: error: there is no field gamma_s\n  help: did you mean warp.gamma_s_deg or "
            "weft.gamma_s_deg?");
  EXPECT_EQ(fault({"warp.gamma_s=4"}),
            "--set warp.gamma_s=4: error: there is no field warp.gamma_s\n  help: did you mean warp.gamma_s_deg?");
  EXPECT_EQ(fault({"warp.eta"}),
            "--set warp.eta: error: has no =, expected path=value\n  help: for example warp.gamma_s_deg=4");
  EXPECT_EQ(fault({"inherits=velvet"}),
            "--set inherits=velvet: error: there is no field inherits\n  help: choose the look itself instead");
  for (const char* value : {"", "abc", "NaN", "1e999", "1 2", "4,5", "1;", "\"4\""})
    EXPECT_NE(fault({std::string("warp.eta=") + value}).find("error: warp.eta is "), std::string::npos)
        << value << fault({std::string("warp.eta=") + value});
  EXPECT_EQ(fault({"warp.lengths=1,x"}),
            "--set warp.lengths=1,x: error: warp.lengths is the text \"1,x\", expected a list of 1 to 63 numbers");
  EXPECT_EQ(fault({"back=velvt"}), "--set back=velvt: error: there is no look velvt\n  help: did you mean velvet?");
}

TEST(Overrides, ReportAllFaultsAndLeaveTheLookAlone) {
  use_source_tree();
  Look look = read_look("linen_plain");
  const std::string before = all_values(look);
  const std::string message = error_of([&] {
    apply_overrides(look, {"warp.eta=2", "warp.eta=9", "nothing=1", "weft.k_d=2"});
  });
  EXPECT_EQ(message,
            "--set warp.eta=9: error: warp.eta is 9, expected 1 to 3\n"
            "--set nothing=1: error: there is no field nothing\n"
            "  help: the nearest are title, source, color, pattern.look; sateen look schema --fields lists all\n"
            "--set weft.k_d=2: error: weft.k_d is 2, expected 0 to 1\n"
            "  help: did you mean 0.2?");
  EXPECT_EQ(all_values(look), before);
}

TEST(Overrides, AreCheckedTogetherAfterTheLast) {
  EXPECT_EQ(fault({"warp.offsets_deg=-9,0,9", "warp.lengths=1,1"}), "(no error)");
  EXPECT_EQ(fault({"warp.offsets_deg=-9,0,9"}),
            "--set warp.offsets_deg=-9,0,9: error: warp has 1 lengths, expected 2 for its 3 offsets\n"
            "  help: one length for each piece between neighbouring offsets");
  EXPECT_EQ(
      fault({"warp.coverage=1"}),
      "--set warp.coverage=1: error: the coverage of warp (1) and weft (0.33) adds up to 1.33, expected 0.001 to 1");
}

TEST(Overrides, PutColoursIntoTheSpaceSetBesideThem) {
  use_source_tree();
  const Look look = read_look("linen_plain", {"warp.color=.1,.2,.3", "color_space=acescg"});
  EXPECT_EQ(look.color_space, "acescg");
  EXPECT_EQ(look.warp.color->space, "");
  EXPECT_EQ(look.weft.A.space, "lin_rec709");
}

}  // namespace
}  // namespace sateen
