#include "image/png_chunks.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "image/file.h"
#include "image/made_files.h"
#include "image/scratch_folder.h"

namespace sateen_test {
namespace {

using namespace sateen;

// What libpng finds wrong it writes to standard error by itself.
TEST(PngChunks, RefuseWhatIsCutShortOrChangedWithoutAWordOnTheTerminal) {
  const ScratchFolder folder;
  const auto path = folder.path / "a.png";
  Image image(16, 8, 3);
  for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = float(i % 7) / 7;
  write_display_image(path, image);
  const std::string whole = read_bytes(path);
  EXPECT_NO_THROW(read_image(path));
  const auto refusal = [&](const std::string& bytes) {
    write_bytes(path, bytes);
    testing::internal::CaptureStderr();
    std::string said = "(taken)";
    try {
      read_image(path);
    } catch (const InputError& error) {
      said = error.diagnostics[0].message;
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << said;
    return said;
  };
  for (size_t length = 9; length < whole.size(); length += 5)
    EXPECT_EQ(refusal(whole.substr(0, length)).rfind("ends ", 0), 0u) << length;
  const size_t data = whole.find("IDAT");
  for (size_t at = data + 4; at < data + 20; ++at) {
    std::string changed = whole;
    changed[at] = char(changed[at] ^ 4);
    EXPECT_EQ(refusal(changed), "the check sum of its chunk IDAT is wrong");
  }
  std::string torn = whole;
  torn[data] = '\0';
  EXPECT_EQ(refusal(torn), "has something between its chunks that is none");
  // Behind the picture may be anything, and a text's check sum may be wrong.
  EXPECT_EQ(refusal(whole + "more"), "(taken)");
  EXPECT_FALSE([&] {
    write_bytes(path, whole.substr(0, whole.size() - 20));
    return image_decodes(path);
  }());
}

}  // namespace
}  // namespace sateen_test
