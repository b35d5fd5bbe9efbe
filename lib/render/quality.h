#pragma once

namespace sateen {

/// A quality that pictures are asked for by name, as an error E (film/error.h).
struct NamedQuality {
  const char* name;
  double error;
};

/// By eye on the shipped looks: noise stands out above 10 %, can be worked with at 4 %, and is gone at 1 %.
inline constexpr NamedQuality named_qualities[] = {{"draft", 0.10}, {"preview", 0.04}, {"final", 0.01}};

}  // namespace sateen
