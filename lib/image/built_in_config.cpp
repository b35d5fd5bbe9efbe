#include "image/built_in_config.h"

namespace sateen {

const std::string_view built_in_config_text = R"yaml(ocio_profile_version: 2.1

name: sateen
description: Small config for cloth pictures, made of transforms that OpenColorIO carries itself.
environment: {}
search_path: ""
strictparsing: true
luma: [0.2126, 0.7152, 0.0722]

roles:
  aces_interchange: aces2065-1
  cie_xyz_d65_interchange: cie_xyz_d65_display
  scene_linear: acescg
  rendering: acescg
  compositing_log: acescct
  color_timing: acescct
  color_picking: srgb_texture
  matte_paint: srgb_texture
  texture_paint: srgb_texture
  data: raw
  default: raw

file_rules:
  - !<Rule> {name: Default, colorspace: default}

displays:
  sRGB:
    - !<View> {name: ACES SDR, view_transform: aces_sdr_video, display_colorspace: srgb_display}
    - !<View> {name: Un-tone-mapped, view_transform: un_tone_mapped, display_colorspace: srgb_display}
    - !<View> {name: Raw, colorspace: raw}
  Rec.1886 Rec.709:
    - !<View> {name: ACES SDR, view_transform: aces_sdr_video, display_colorspace: rec1886_rec709_display}
    - !<View> {name: Un-tone-mapped, view_transform: un_tone_mapped, display_colorspace: rec1886_rec709_display}
    - !<View> {name: Raw, colorspace: raw}

active_displays: []
active_views: []
inactive_colorspaces: []

default_view_transform: un_tone_mapped

view_transforms:
  - !<ViewTransform>
    name: un_tone_mapped
    description: The scene's light as it is, adapted to D65; above 1 it clips.
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}

  - !<ViewTransform>
    name: aces_sdr_video
    description: ACES 1.0 output transform for a 100 nit video display.
    from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}

display_colorspaces:
  - !<ColorSpace>
    name: cie_xyz_d65_display
    description: CIE XYZ of the display, D65, Y = 1 at 100 nit.
    isdata: false

  - !<ColorSpace>
    name: srgb_display
    description: IEC 61966-2-1, piecewise curve.
    isdata: false
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}

  - !<ColorSpace>
    name: rec1886_rec709_display
    description: Rec.709 primaries, power curve of 2.4.
    isdata: false
    from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709}

colorspaces:
  - !<ColorSpace>
    name: aces2065-1
    aliases: [aces, lin_ap0, ACES2065-1]
    description: The reference; linear, AP0 primaries, ACES white.
    encoding: scene-linear
    isdata: false

  - !<ColorSpace>
    name: acescg
    aliases: [lin_ap1, ACEScg]
    description: The usual working space; linear, AP1 primaries, ACES white.
    encoding: scene-linear
    isdata: false
    to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}

  - !<ColorSpace>
    name: acescct
    description: Logarithmic with a toe, AP1 primaries; for colour timing and pickers.
    encoding: log
    isdata: false
    to_scene_reference: !<BuiltinTransform> {style: ACEScct_to_ACES2065-1}

  - !<ColorSpace>
    name: lin_rec709
    aliases: [lin_srgb, linear_rec709]
    description: Linear, Rec.709 and sRGB primaries, D65.
    encoding: scene-linear
    isdata: false
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}

  - !<ColorSpace>
    name: srgb_texture
    aliases: [sRGB - Texture, srgb]
    description: Rec.709 primaries, D65, sRGB curve; pictures and colour pickers.
    encoding: sdr-video
    isdata: false
    from_scene_reference: !<GroupTransform>
      children:
        - !<BuiltinTransform> {style: ACEScg_to_ACES2065-1, direction: inverse}
        - !<BuiltinTransform> {style: UTILITY - ACES-AP1_to_LINEAR-REC709_BFD}
        - !<ExponentWithLinearTransform> {gamma: 2.4, offset: 0.055, style: mirror, direction: inverse}

  - !<ColorSpace>
    name: cie_xyz_d65
    description: CIE XYZ of the scene, Bradford-adapted to D65.
    encoding: scene-linear
    isdata: false
    from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}

  - !<ColorSpace>
    name: raw
    aliases: [Utility - Raw]
    description: Numbers that are not colours.
    encoding: data
    isdata: true
)yaml";

}  // namespace sateen
