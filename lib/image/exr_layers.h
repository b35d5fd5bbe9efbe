#pragma once
#include <array>
#include <string>
#include <vector>

namespace sateen {

/// What the channels of a layer are together.
enum class LayerKind {
  rgb,
  xyz,    ///< CIE XYZ
  grey,   ///< one channel, Y as a rule
  chroma  ///< luminance Y and the colour differences RY and BY, which may be of half the size
};

/// Channels of one part of an OpenEXR file that make colours.
struct ExrLayer {
  std::string name;  ///< of the part, where there are several, and what stands before the channels' last dot
  LayerKind kind = LayerKind::rgb;
  int part = 0;
  bool guessed = false;                 ///< chosen for nothing but its place or for being the only one
  bool plain = false;                   ///< channels without a name before them: R and not beauty.R
  std::array<std::string, 3> channels;  ///< full names; of grey the first alone
  bool alone = false;                   ///< one channel, taken by its own name or because there is no other
};

/// A part as its header describes it.
struct ExrPart {
  std::string name;  ///< empty where the file does not say
  bool deep = false;
  std::vector<std::string> channels;       ///< full names
  std::vector<std::string> whole_numbers;  ///< those of integers, which are names of objects as a rule
};

/// Every layer of the flat parts, in the file's order.
std::vector<ExrLayer> exr_layers(const std::vector<ExrPart>& parts);

/// Index of the layer that holds the picture. `wanted` names one, in any case: its full name, the end of it behind a
/// dot where one alone ends so, or a single channel, which is grey. Else: plain R, G, B, of several parts the one
/// named as below, else the first; then Combined, rgba or beauty; the only one with colours; plain X, Y, Z; plain Y
/// with RY and BY; plain Y; the only Y with RY and BY; a file's only channel beside alpha. Channels and layers whose
/// names say that they are mattes, depths or names of objects are not guessed. -1 where nothing of that is there. A
/// single channel asked for or left over is appended to `layers`.
int choose_layer(const std::vector<ExrPart>& parts, const std::string& wanted, std::vector<ExrLayer>& layers);

/// The same for one number a pixel, which may be anything: a file's only channel beside alpha, Y, or R of what would
/// be the picture, plain R. What it chooses is grey.
int choose_number(const std::vector<ExrPart>& parts, const std::string& wanted, std::vector<ExrLayer>& layers);

/// The channel that is a layer's alpha; empty where it has none.
std::string alpha_of(const std::vector<ExrPart>& parts, const ExrLayer& layer);

/// "layer sky is taken as the light, the only one with colours": what is told of a layer that was guessed.
std::string guess_text(const ExrLayer& layer, const char* what);

/// "View Layer.Combined (R, G, B), depth (Z)": what a refusal lists, at most 20.
std::string layers_text(const std::vector<ExrPart>& parts);

}  // namespace sateen
