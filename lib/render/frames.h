#pragma once
#include <string>
#include <vector>

namespace sateen {

/// Frames of "1-100", "1-100x2", "1..10", "1,5,9" and mixtures, in the order given, each once. InputError for
/// anything else, a range that runs backwards, numbers above 999,999 or more than 100,000 frames.
std::vector<int> parse_frames(const std::string& text);

/// Whether the file's name has a place for the frame's number: # (4 digits), ### (as many), %d, %04d, $F, $F4.
bool has_frame_place(const std::string& pattern);

/// The name with its number. Without a place: the name as it is. InputError for two places.
std::string frame_name(const std::string& pattern, int frame);

}  // namespace sateen
