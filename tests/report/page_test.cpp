#include <gtest/gtest.h>

#include <regex>

#include "base/error.h"
#include "report/page.h"

namespace sateen_test {

using namespace sateen;

TEST(Table, TextColumnsAreEvenAndNumbersStandToTheRight) {
  EXPECT_EQ(table_text({{"scene", "MSE"}, {{"satin", "0.5"}, {"crepe, studio", "12"}}}),
            "scene          MSE\n"
            "satin          0.5\n"
            "crepe, studio   12\n");
}

TEST(Table, FlagsAreNoNumbers) {
  EXPECT_EQ(table_text({{"flags", "n"}, {{"--spp 8", "-1"}, {"-s 16 --level 2", "-"}}}),
            "flags             n\n"
            "--spp 8          -1\n"
            "-s 16 --level 2   -\n");
}

TEST(Table, CsvQuotesWhatWouldBreakIt) {
  EXPECT_EQ(table_csv({{"a", "b"}, {{"x, \"y\"", "line\nbreak"}, {"plain", "1"}}}),
            "a,b\n\"x, \"\"y\"\"\",\"line\nbreak\"\nplain,1\n");
}

TEST(Table, HtmlEscapesAndMarksWhatPassed) {
  const std::string html = table_html({{"<bar>", "found"}, {{"a & b", "holds"}, {"c", "does not hold"}}});
  EXPECT_NE(html.find("<th>&lt;bar&gt;</th>"), std::string::npos) << html;
  EXPECT_NE(html.find("<td>a &amp; b</td>"), std::string::npos);
  EXPECT_NE(html.find("<td class=\"holds\">holds</td>"), std::string::npos);
  EXPECT_NE(html.find("<td class=\"fails\">does not hold</td>"), std::string::npos);
}

TEST(Table, NumbersThatAreNotFiniteAreADash) {
  EXPECT_EQ(number_text(0.012345), "0.0123");
  EXPECT_EQ(number_text(0.0 / 0.0), "-");
}

TEST(Page, DataAddressesAreBase64) {
  EXPECT_EQ(data_uri("a/b", ""), "data:a/b;base64,");
  EXPECT_EQ(data_uri("a/b", "f"), "data:a/b;base64,Zg==");
  EXPECT_EQ(data_uri("a/b", "fo"), "data:a/b;base64,Zm8=");
  EXPECT_EQ(data_uri("a/b", "foo\xff"), "data:a/b;base64,Zm9v/w==");
}

TEST(Page, StandsAloneWithEveryElementClosed) {
  Page page("Prices & errors", "What accuracy costs.");
  page.section("Error < time");
  page.paragraph("5 > 3");
  page.table({{"a"}, {{"1"}}});
  Plot plot;
  plot.title = "p";
  plot.series.push_back({"s", {{1, 1}, {2, 2}}});
  PlotSheet sheet;
  sheet.panels = {plot};
  page.plot(sheet, "a plot");
  page.slider("two", {{"left", data_uri("image/png", "x")}, {"right", data_uri("image/png", "y")}}, 480);
  const std::string html = page.html();
  for (const char* element : {"html", "head", "body", "main", "figure", "table", "tr", "td", "template", "div",
                              "select", "option", "label", "script", "style", "h2", "p", "figcaption", "span"}) {
    const auto count = [&](const std::string& pattern) {
      const std::regex expression(pattern);
      return std::distance(std::sregex_iterator(html.begin(), html.end(), expression), std::sregex_iterator());
    };
    EXPECT_EQ(count(std::string("<") + element + "[ >]"), count(std::string("</") + element + ">")) << element;
    EXPECT_GT(count(std::string("<") + element + "[ >]"), 0) << element;
  }
  // Nothing is fetched: every address is one of data.
  for (const char* word : {"http:", "https:", "//cdn", "@import", "url(", "<link"})
    EXPECT_EQ(html.find(word), std::string::npos) << word;
  const std::regex address("(src|href)=\"([^\"]*)\"");
  for (std::sregex_iterator it(html.begin(), html.end(), address), end; it != end; ++it)
    EXPECT_EQ((*it)[2].str().rfind("data:", 0), 0u) << (*it)[2].str().substr(0, 40);
  EXPECT_NE(html.find("Prices &amp; errors"), std::string::npos);
}

TEST(Page, ASliderOfOnePictureIsRefused) {
  Page page("t", "l");
  try {
    page.slider("one", {{"left", "data:,"}}, 100);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "error: a slider compares pictures and has 1, expected 2 or more");
  }
}

TEST(Page, APictureOfAnotherKindIsRefused) {
  try {
    picture_uri("a.exr");
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "error: a.exr: a page holds pictures of kind png, jpg and svg");
  }
}

}  // namespace sateen_test
