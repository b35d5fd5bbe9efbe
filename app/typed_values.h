#pragma once
#include <string>
#include <utility>

namespace sateen::app {

/// "30", "30s", "2m", "1h30m", "90 sec" or "1min" in seconds, above 0; InputError names `what` and the form.
double read_duration(const std::string& what, const std::string& text);

/// Whether a word may go on with a duration: "min", "30s".
bool continues_duration(const std::string& word);

/// "640 360", "640x360", "640 x 360" or "640,360" as width and height, each from `least` to its most.
std::pair<int, int> read_size(const std::string& what, const std::string& text, int least, std::pair<int, int> most);

/// Whether a word may go on with a size: "x", "360".
bool continues_size(const std::string& word);

}  // namespace sateen::app
