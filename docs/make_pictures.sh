#!/usr/bin/env bash
# Makes the pictures of the README anew:   docs/make_pictures.sh [hero|looks|lights|meshes|garments|turntable|lobe|cost|effects|weave]...
# A quarter of an hour on one core. SATEEN: the program (build/bin/sateen). GARMENTS and MAPS: folders with the
# garments of MakeHuman and HDR maps by Greg Zaal, both CC0; without them those pictures are left as they are.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
sateen=${SATEEN:-build/bin/sateen}
garments=${GARMENTS:-../shared/meshes/makehuman}
maps=${MAPS:-../shared/hdri}
out=docs/pictures
mkdir -p "$out"

picture() {  # picture NAME [flags]
  "$sateen" render -q --progress none -o "$out/$1.jpg" "${@:2}"
  echo "$out/$1.jpg"
}

small=(-r 320 180 -s 96 --adaptive)

hero() { picture hero -s 96 --adaptive; }

looks() {
  for file in looks/*.json; do
    name=$(basename "$file" .json)
    picture "look_$name" -l "$name" "${small[@]}"
  done
}

lights() {
  for name in studio_softboxes three_light_rig low_sun overcast; do
    picture "light_$name" -l emerald_satin -e "$name" "${small[@]}"
  done
}

meshes() {
  picture skirt -m skirt -l rose_gold_satin --elevation 10 -r 360 360 -s 96 --adaptive
  picture tour_wide -l emerald_satin --set warp.gamma_s_deg=12 --set warp.gamma_v_deg=24 "${small[@]}"
}

garments() {
  if [ ! -d "$garments" ] || [ ! -d "$maps" ]; then
    echo "no $garments or no $maps: garments are left as they are" >&2
    return
  fi
  picture suit_satin -m "$garments/female_elegantsuit01.obj" -e "$maps/studio.exr" -l emerald_satin --elevation 8 \
    -r 300 400 -s 96 --adaptive
  picture suit_silk -m "$garments/male_casualsuit01.obj" -e "$maps/apartment.exr" -l silk_crepe_de_chine --elevation 8 \
    -r 300 400 -s 96 --adaptive
}

turntable() {
  local frames
  frames=$(mktemp -d)
  "$sateen" turntable -q --progress none -l shot_taffeta -n 6 -r 270 180 \
    -s 64 --adaptive -o "$frames/f.####.png" --sheet "$out/turntable.jpg"
  rm -r "$frames"
  echo "$out/turntable.jpg"
}

lobe() {
  "$sateen" lobe polyester_satin_charmeuse -o "$out/lobe.png" >/dev/null
  echo "$out/lobe.png"
}

cost() {
  local list
  list=$(mktemp -d)
  "$sateen" cost -q -l emerald_satin -e low_sun -s 64 -o "$list"
  cp "$list/error_time.png" "$out/cost.png"
  rm -r "$list"
  echo "$out/cost.png"
}

# Pairs: the same scene without and with an effect.
effects() {
  local pair=(-r 640 360 -s 48)
  picture effect_maps_off -l printed_silk --set color=0.72,0.62,0.5 "${pair[@]}"
  picture effect_maps_on -l printed_silk "${pair[@]}"
  picture effect_pattern_off -l silk_damask --set pattern.mask=0 "${pair[@]}"
  picture effect_pattern_on -l silk_damask "${pair[@]}"
  picture effect_gaps_off -l silk_organza --effects auto,-gaps -r 640 360 -s 64 --bounces 1
  picture effect_gaps_on -l silk_organza -r 640 360 -s 64 --bounces 1
  picture effect_interreflection_off -l ivory_duchess_satin -m skirt --elevation 10 --bounces 0 -r 640 360 -s 96 --adaptive
  picture effect_interreflection_on -l ivory_duchess_satin -m skirt --elevation 10 -r 640 360 -s 192 --adaptive
  picture effect_self_shadowing_off -l emerald_satin --effects none -r 640 360 -s 64 --adaptive
  picture effect_self_shadowing_on -l emerald_satin --effects none,+self-shadowing -r 640 360 -s 64 --adaptive
  picture effect_back_off -l polyester_satin_charmeuse --effects auto,-back -r 640 360 -s 64 --adaptive
  picture effect_back_on -l polyester_satin_charmeuse -r 640 360 -s 64 --adaptive
  local wide=(-r 640 360 -s 48 --adaptive --bounces 1)
  picture effect_ground_off "${wide[@]}"
  picture effect_ground_on --ground floor "${wide[@]}"
  picture effect_ground_cyclorama --ground cyclorama --ground-color 0.25,0.3,0.36 "${wide[@]}"
  picture effect_motion_blur_off --ground floor -l emerald_satin "${wide[@]}"
  picture effect_motion_blur_on --ground floor -l emerald_satin --shutter 12 "${wide[@]}"
  picture effect_references_off --ground floor -l crimson_velvet "${wide[@]}"
  picture effect_references_on --ground floor -l crimson_velvet --references "${wide[@]}"
  if [ ! -d "$maps" ]; then
    echo "no $maps: depth of field and backdrops are left as they are" >&2
    return
  fi
  local outside=(-e "$maps/city.exr" -l rose_gold_satin --ground catcher --backdrop environment --elevation 8)
  picture effect_dof_off "${outside[@]}" --zoom 1.5 "${wide[@]}"
  picture effect_dof_on "${outside[@]}" --zoom 1.5 --f-stop 1.2 "${wide[@]}"
  local forest=(-e "$maps/forest.exr" -l rose_gold_satin --elevation 4)
  picture effect_backdrop_off "${forest[@]}" --backdrop environment "${wide[@]}"
  picture effect_backdrop_on "${forest[@]}" --backdrop blurred:30 "${wide[@]}"
}

# The same frame with the threads' mean and with the threads themselves, and a camera that comes nearer.
weave() {
  local near=(-m swatch -l shot_taffeta --zoom 70 -r 640 360 -s 64 --adaptive)
  picture effect_weave_off "${near[@]}" --effects auto,-weave
  picture effect_weave_on "${near[@]}"
  if ! command -v montage >/dev/null; then
    echo "no montage (ImageMagick): weave_zoom is left as it is" >&2
    return
  fi
  local strip zoom
  strip=$(mktemp -d)
  for zoom in 1 6 24 80 400; do
    "$sateen" render -q --progress none -m swatch -l champagne_silk_satin --elevation 27 --fov 6 --zoom "$zoom" -r 256 192 \
      -s 48 --adaptive -o "$strip/$(printf %03d "$zoom").png"
  done
  montage "$strip"/*.png -tile 5x1 -geometry +2+0 "$out/weave_zoom.jpg"
  rm -r "$strip"
  echo "$out/weave_zoom.jpg"
}

[ $# -gt 0 ] || set -- hero looks lights meshes garments turntable lobe cost effects weave
for part in "$@"; do "$part"; done
