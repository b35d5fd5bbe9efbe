#include "base/text_encoding.h"

#include <gtest/gtest.h>

namespace sateen {
namespace {

using namespace std::string_view_literals;

TEST(TextEncoding, WideTextIsToldByItsMarkOrItsZeros) {
  EXPECT_EQ(wide_text_complaint("\xff\xfev\0"sv), "is UTF-16 text, expected UTF-8 or plain ASCII text");
  EXPECT_EQ(wide_text_complaint("\xfe\xff"sv), "is UTF-16 text, expected UTF-8 or plain ASCII text");
  for (const std::string_view text : {"v\0 \0"sv, "\0v\0 "sv, "\0\0\0v"sv})
    EXPECT_EQ(wide_text_complaint(text), "is UTF-16 text, or no text at all, expected UTF-8 or plain ASCII text");
  for (const std::string_view text : {""sv, "v"sv, "v 0 0"sv, "\xef\xbb\xbfv"sv, "v 0 \0"sv, "v\0"sv})
    EXPECT_EQ(wide_text_complaint(text), "");
}

TEST(TextEncoding, TheEndThatDosWritesEndsTextOnlyWhereNothingFollows) {
  for (const std::string_view text : {"a\n\x1a"sv, "a\n\x1a\x1a\0\0"sv, "a\n\x1a\r\n"sv, "a\n"sv})
    EXPECT_EQ(without_dos_end(text), "a\n");
  EXPECT_EQ(without_dos_end("\x1a\0"sv), "");
  for (const std::string_view text : {""sv, "a\0\0"sv, "a\x1a\nb"sv, " \n "sv})
    EXPECT_EQ(without_dos_end(text), text);
  EXPECT_EQ(without_dos_end("a\x1a\nb\x1a "sv), "a\x1a\nb"sv);
}

}  // namespace
}  // namespace sateen
