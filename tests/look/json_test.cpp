#include "look/json.h"

#include "base/parallel.h"
#include "look_text.h"

namespace sateen {
namespace {

std::string fault(const std::string& text) {
  return error_of([&] { parse_json(text, "a.json"); });
}

TEST(Json, TellsWhereEveryKeyAndValueStands) {
  const JsonDocument document = parse_json(
      "\xef\xbb\xbf{ // note\r\n  \"a\\\"\\\\\" : [1, -2.5e1,\n\"\xc3\xa9\"], /* x */ \"b\":{}}", "a.json");
  ASSERT_EQ(document.root.items.size(), 2u);
  const JsonValue& list = document.root.items[0];
  EXPECT_EQ(list.key, "a\"\\");
  EXPECT_EQ(list.key_place.line, 2);
  EXPECT_EQ(list.key_place.column, 3);
  EXPECT_EQ(list.key_place.width, 7);
  EXPECT_EQ(list.place.column, 13);
  ASSERT_EQ(list.items.size(), 3u);
  EXPECT_EQ(list.items[0].text, "1");
  EXPECT_EQ(list.items[1].number, -25);
  EXPECT_EQ(list.items[1].place.column, 17);
  EXPECT_EQ(list.items[1].place.width, 6);
  EXPECT_EQ(list.items[2].text, "\xc3\xa9");
  EXPECT_EQ(list.items[2].place.line, 3);
  EXPECT_EQ(list.items[2].place.width, 4);
  const JsonValue* object = document.root.find("b");
  ASSERT_TRUE(object);
  EXPECT_EQ(object->kind, JsonValue::Kind::object);
  EXPECT_EQ(object->place.width, 2);
}

TEST(Json, ReadsANumberThatEndsTheText) {
  const JsonDocument document = parse_json("123", "a.json");
  EXPECT_EQ(document.root.text, "123");
  EXPECT_EQ(document.root.place.width, 3);
}

TEST(Json, ReadsIntegersOfAnySizeAsTheNumbersTheyAre) {
  EXPECT_EQ(parse_json("18446744073709551616", "").root.number, 18446744073709551616.0);
  EXPECT_EQ(parse_json("-9223372036854775809", "").root.number, -9223372036854775808.0);
  EXPECT_EQ(parse_json("1e308", "").root.number, 1e308);
  EXPECT_EQ(parse_json("1e-999", "").root.number, 0);
}

TEST(Json, ExplainsFaultsOfSyntaxInItsOwnWords) {
  const std::pair<const char*, const char*> cases[] = {
      {"{\"a\": 1,}",
       "a.json:1:8: error: found a comma before }, expected none\n    1 | {\"a\": 1,}\n      |        ^\n"
       "  help: remove the comma"},
      {"[1, 2, ]",
       "a.json:1:6: error: found a comma before ], expected none\n    1 | [1, 2, ]\n      |      ^\n"
       "  help: remove the comma"},
      {"{\"a\": 1 \"b\": 2}",
       "a.json:1:9: error: found \"b\", expected , or }\n    1 | {\"a\": 1 \"b\": 2}\n      |         ^^^\n"
       "  help: a comma is missing before it"},
      {"{a: 1}",
       "a.json:1:2: error: found a, expected a key in double quotes, or }\n    1 | {a: 1}\n      |  ^\n"
       "  help: texts and keys stand in double quotes"},
      {"{'a': 1}",
       "a.json:1:2: error: found 'a', expected a key in double quotes, or }\n    1 | {'a': 1}\n      |  ^^^\n"
       "  help: texts and keys stand in double quotes"},
      {"{\"a\" = 1}",
       "a.json:1:6: error: found =, expected : behind the key\n    1 | {\"a\" = 1}\n      |      ^\n"
       "  help: write : instead"},
      {"{\"a\": NaN}",
       "a.json:1:7: error: found NaN, expected a finite number\n    1 | {\"a\": NaN}\n      |       ^^^"},
      {"{\"a\": -Infinity}",
       "a.json:1:7: error: found -Infinity, expected a finite number\n    1 | {\"a\": -Infinity}\n"
       "      |       ^^^^^^^^^"},
      {"{\"a\": 1e999}",
       "a.json:1:7: error: found 1e999, expected a finite number\n    1 | {\"a\": 1e999}\n      |       ^^^^^"},
      {"{\"a\": True}",
       "a.json:1:7: error: found True, expected a value\n    1 | {\"a\": True}\n      |       ^^^^\n"
       "  help: did you mean true?"},
      {"{\"a\": .5}",
       "a.json:1:7: error: found .5, expected a number such as 12, 0.5 or 1e-3\n    1 | {\"a\": .5}\n"
       "      |       ^^"},
      {"{\"a\": 012}",
       "a.json:1:7: error: found 012, expected a number such as 12, 0.5 or 1e-3\n    1 | {\"a\": 012}\n"
       "      |       ^^^"},
      {"{\"a\": 1.}",
       "a.json:1:7: error: found 1., expected a number such as 12, 0.5 or 1e-3\n    1 | {\"a\": 1.}\n"
       "      |       ^^"},
      {"{\"a\": 12px}",
       "a.json:1:7: error: found 12px, expected a number such as 12, 0.5 or 1e-3\n    1 | {\"a\": 12px}\n"
       "      |       ^^^^"},
      {"{\"a\": \"x\n\"}",
       "a.json:1:7: error: the text is not closed, expected \" before the end of the line\n    1 | {\"a\": \"x\n"
       "      |       ^^"},
      {"{\"a\": \"x",
       "a.json:1:7: error: the text is not closed, expected \" before the end of the line\n    1 | {\"a\": \"x\n"
       "      |       ^^"},
      {"{\"a\": \"x\ty\"}",
       "a.json:1:9: error: found a tab inside a text, expected \\t\n    1 | {\"a\": \"x\ty\"}\n      |         ^"},
      {"{\"a\": \"x\\qy\"}",
       "a.json:1:9: error: found a backslash that begins no escape\n    1 | {\"a\": \"x\\qy\"}\n      |         ^^\n"
       "  help: write \\\\ for a backslash; the others are \\\" \\/ \\b \\f \\n \\r \\t and \\u with four hex "
       "digits"},
      {"{\"a\": \"\\ud800x\"}",
       "a.json:1:8: error: \\ud800 is half a character, expected a pair\n    1 | {\"a\": \"\\ud800x\"}\n"
       "      |        ^^^^^^"},
      {"{\n  \"a\": [1, 2\n}\n", "a.json:3:1: error: found }, expected , or ]\n    3 | }\n      | ^"},
      {"{\n  \"a\": 1\n",
       "a.json:2:9: error: ends here, expected , or }\n    2 |   \"a\": 1\n      |         ^\n"
       "  help: the { of line 1 is not closed"},
      {"{} {}", "a.json:1:4: error: found {, expected nothing more\n    1 | {} {}\n      |    ^"},
      {"{} # note",
       "a.json:1:4: error: found #, expected nothing more\n    1 | {} # note\n      |    ^\n"
       "  help: a comment begins with //"},
      {"{} /* note", "a.json:1:4: error: the comment is not closed, expected */\n    1 | {} /* note\n      |    ^^"},
      {"", "a.json:1:1: error: is empty, expected a value"},
  };
  for (const auto& [text, expected] : cases) EXPECT_EQ(fault(text), expected) << text;
}

TEST(Json, RefusesBytesThatAreNoUtf8) {
  EXPECT_EQ(fault("[\"\xff\"]").substr(0, 65), "a.json:1:3: error: found byte 0xff, which is not valid UTF-8\n    ");
  EXPECT_NE(fault("[\"\xc3(\"]").find("which is not valid UTF-8"), std::string::npos);
  EXPECT_NE(fault("\xff\xfe[\0]").find("error"), std::string::npos);
}

TEST(Json, RefusesAZeroByteInsteadOfStoppingThere) {
  EXPECT_EQ(fault(std::string("{}\0 x", 5)),
            "a.json:1:3: error: found a zero byte, expected text\n    1 | {}\\x00 x\n      |   ^^^^");
}

TEST(Json, NamesBothPlacesOfAKeyGivenTwice) {
  const JsonDocument document = parse_json("{\"a\": 1,\n \"b\": 2, \"a\": 3, \"a\": 4}", "a.json");
  ASSERT_EQ(document.problems.size(), 2u);
  EXPECT_EQ(to_string(document.problems[0]),
            "a.json:2:10: error: a is given twice, first at 1:2\n    2 |  \"b\": 2, \"a\": 3, \"a\": 4}\n"
            "      |          ^^^");
  ASSERT_EQ(document.root.items.size(), 2u);
  EXPECT_EQ(document.root.find("a")->number, 1);
  EXPECT_EQ(document.root.find("b")->number, 2);
}

TEST(Json, StopsAtDepth64HoweverManyBracketsFollow) {
  EXPECT_EQ(fault(std::string(64, '[') + std::string(64, ']')), "(no error)");
  const double before = cpu_seconds();
  for (const char* bracket : {"[", "{\"a\":"}) {
    std::string bomb;
    for (int i = 0; i < 100000; ++i) bomb += bracket;
    const std::string message = fault(bomb);
    EXPECT_NE(message.find("error: nested deeper than 64 levels"), std::string::npos) << message;
  }
  EXPECT_LT(cpu_seconds() - before, 1);
}

TEST(Json, RefusesMoreThan8MiBAndMoreThanHalfAMillionValues) {
  EXPECT_EQ(fault(std::string(json_most_bytes + 1, ' ')),
            "a.json: error: is 8388609 bytes, expected at most 8388608");
  std::string many = "[0";
  while (many.size() + 3 < json_most_bytes) many += ",0";
  many += "]";
  const double before = cpu_seconds();
  EXPECT_EQ(fault(many), "a.json:1:1000000: error: holds more than 500000 values");
  EXPECT_LT(cpu_seconds() - before, 1);
}

TEST(Json, QuotesAnyUtf8SuchThatItReadsBackTheSame) {
  std::string all;
  for (int c = 0; c < 128; ++c) all += char(c);
  all += "\xc3\xa9\xe2\x82\xac\xf0\x9f\xa7\xb5";
  EXPECT_EQ(parse_json(json_quote(all), "").root.text, all);
}

TEST(Json, ShowsForeignNamesWithoutControlCharactersAndCut) {
  EXPECT_EQ(shown_name("a\x1b[2J"), "a\\x1b[2J");
  EXPECT_EQ(shown_name(""), "\"\"");
  EXPECT_EQ(shown_name(std::string(1000, 'x')), std::string(60, 'x') + "...");
  EXPECT_EQ(shown_name(std::string(59, 'x') + "\xe2\x82\xac"), std::string(59, 'x') + "...");
}

}  // namespace
}  // namespace sateen
