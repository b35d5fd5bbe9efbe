#include "look/json_writer.h"

#include <gtest/gtest.h>

#include <limits>

#include "look/json.h"

namespace sateen {

TEST(JsonWriter, WhatItWritesIsReadBackTheSame) {
  JsonWriter w;
  w.open_object().member("text", "a\"b\\c\n\t\x01").member("whole", -7).member("big", 1234567890123LL);
  w.member("tenth", 0.1)
      .member("yes", true)
      .key("list")
      .open_list()
      .value(1)
      .value("two")
      .open_object()
      .close()
      .close();
  w.key("empty").open_list().close().close();
  const JsonDocument d = parse_json(w.text(), "t");
  EXPECT_EQ(d.root.find("text")->text, "a\"b\\c\n\t\x01");
  EXPECT_EQ(d.root.find("whole")->number, -7);
  EXPECT_EQ(d.root.find("big")->number, 1234567890123.0);
  EXPECT_EQ(d.root.find("tenth")->number, 0.1);
  EXPECT_TRUE(d.root.find("yes")->boolean);
  EXPECT_EQ(d.root.find("list")->items.size(), 3u);
  EXPECT_TRUE(d.root.find("empty")->items.empty());
}

TEST(JsonWriter, OneLineHasNoBreak) {
  JsonWriter w(true);
  w.open_object().member("a", 1).member("b", 2.5).close();
  EXPECT_EQ(w.text(), "{\"a\": 1, \"b\": 2.5}");
}

TEST(JsonWriter, NumbersThatAreNotFiniteAreNull) {
  JsonWriter w(true);
  w.open_list().value(std::numeric_limits<double>::quiet_NaN()).value(std::numeric_limits<float>::infinity()).close();
  EXPECT_EQ(w.text(), "[null, null]");
}

TEST(JsonWriter, BytesThatAreNotUtf8AreReplacedOneByOne) {
  EXPECT_EQ(valid_utf8("caf\xc3\xa9 \xe2\x82\xac"), "caf\xc3\xa9 \xe2\x82\xac");
  EXPECT_EQ(valid_utf8("a\xff"
                       "b\xc0\xaf"),
            "a\xef\xbf\xbd"
            "b\xef\xbf\xbd\xef\xbf\xbd");
  EXPECT_EQ(valid_utf8("\xed\xa0\x80").size(), 9u);
  EXPECT_EQ(valid_utf8("\xf4\x90\x80\x80").size(), 12u);
  EXPECT_EQ(valid_utf8("\xe2\x82"), "\xef\xbf\xbd\xef\xbf\xbd");
}

}  // namespace sateen
