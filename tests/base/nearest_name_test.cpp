#include "base/nearest_name.h"

#include <gtest/gtest.h>

namespace sateen {
namespace {

const std::vector<std::string> looks{"linen_plain", "silk_shot", "velvet", "velvet_red", "silk_crepe_de_chine"};

TEST(NearestName, ForgivesASlipOfEachKind) {
  EXPECT_EQ(nearest_name("velvt", looks), "velvet");    // left out
  EXPECT_EQ(nearest_name("vellvet", looks), "velvet");  // doubled
  EXPECT_EQ(nearest_name("velwet", looks), "velvet");   // another letter
  EXPECT_EQ(nearest_name("vlevet", looks), "velvet");   // swapped
  EXPECT_EQ(nearest_name("VELVET", looks), "velvet");   // case
  EXPECT_EQ(nearest_name("silk_shto", looks), "silk_shot");
}

TEST(NearestName, ASwapIsOneEditAndNotTwo) {
  // Three letters allow one edit.
  EXPECT_EQ(nearest_name("talbe", {"table"}), "table");
  EXPECT_EQ(nearest_name("msi", {"mis"}), "mis");
  EXPECT_EQ(nearest_name("mxy", {"mis"}), "");
}

TEST(NearestName, KeepsQuietWhereNothingIsNear) {
  EXPECT_EQ(nearest_name("chessboard", looks), "");
  EXPECT_EQ(nearest_name("", looks), "");
  EXPECT_EQ(nearest_name("velvet", {}), "");
}

TEST(NearestName, AllowsAThirdOfTheLengthButAtMostFourEdits) {
  EXPECT_EQ(nearest_name("abcdef", {"abcdxy"}), "abcdxy");
  EXPECT_EQ(nearest_name("abcdef", {"abcxyz"}), "");
  const std::string longer(30, 'a');
  EXPECT_EQ(nearest_name(longer, {std::string(26, 'a') + "bbbb"}), std::string(26, 'a') + "bbbb");
  EXPECT_EQ(nearest_name(longer, {std::string(25, 'a') + "bbbbb"}), "");
}

TEST(NearestName, PrefersTheNearestAndOfEqualsTheFirst) {
  EXPECT_EQ(nearest_name("velvet_re", looks), "velvet_red");
  EXPECT_EQ(nearest_name("cat", {"bat", "hat"}), "bat");
}

TEST(Suggestion, NamesTheNearestOrElseAllThatAreKnown) {
  EXPECT_EQ(suggestion("velvt", looks), "did you mean velvet?");
  EXPECT_EQ(suggestion("chessboard", {"a", "b"}), "known: a, b");
  EXPECT_EQ(suggestion("chessboard", {}), "");
}

}  // namespace
}  // namespace sateen
