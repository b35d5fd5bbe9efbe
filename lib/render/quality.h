#pragma once

namespace sateen {

/// A quality that pictures are asked for by name, as an error E (film/error.h).
struct NamedQuality {
  const char* name;
  double error;
};

/// By eye on the shipped looks: noise stands out above 18 %, can be worked with at 7.5 %, and is gone at
/// 1.8 %.
inline constexpr NamedQuality named_qualities[] = {{"draft", 0.18}, {"preview", 0.075}, {"final", 0.018}};

}  // namespace sateen
