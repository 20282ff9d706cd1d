#!/usr/bin/env bash
# Makes the pictures of the READMEs anew: the repository's, and those of rendering/, rendering/bodies/, rendering/friction/,
# rendering/needle/, host_tools/certify/, host_tools/python/ and host_tools/reach/. Needs a built `tactus`:
# host_tools/demo.sh builds one.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

tactus="${1:-build/release/bin/tactus}"
if [[ ! -x "$tactus" ]]; then
  echo "host_tools/pictures.sh: no program $tactus; run host_tools/demo.sh first, or give its path" >&2
  exit 2
fi
work="$(mktemp -d)"
trap 'rm -r "$work"' EXIT
examples=host_tools/examples
pictures=rendering/pictures
mkdir -p "$pictures"

touch_scene() {  # SCENE.toml PATH.csv NAME
  "$tactus" bake "$examples/$1" -o "$work/$3.tactus" >"$work/log"
  "$tactus" touch "$work/$3.tactus" --path "$examples/$2" --output "$work/$3.csv" >"$work/log"
}
draw() {  # NAME FIGURE [OTHER]
  "$tactus" plot "$work/$1.csv" --scene "$work/$1.tactus" -o "$work/" ${3:+--against "$work/$3.csv"} >"$work/log"
  cp "$work/$1_$2.png" "$pictures/$1_$2.png"
  echo "$pictures/$1_$2.png"
}

touch_scene thin_plate/scene.toml thin_plate/press.csv potential_field
touch_scene thin_plate/proxy.toml thin_plate/press.csv sphere_proxy
draw sphere_proxy against potential_field
touch_scene shaded_cylinder/scene.toml shaded_cylinder/round.csv shaded
touch_scene shaded_cylinder/faceted.toml shaded_cylinder/round.csv faceted
draw shaded against faceted
touch_scene heart/scene.toml heart/stroke.csv heart
draw heart path
touch_scene heart/scene.toml heart/gyroid.csv gyroid
draw gyroid path
touch_scene grating/scene.toml grating/stroke.csv grating
draw grating force

# Bodies: a strip of each example.
pictures=rendering/bodies/pictures
mkdir -p "$pictures"
strip() {  # EXAMPLE PATH...
  local paths=() name="$1"
  for path in "${@:2}"; do paths+=(--path "$examples/$name/$path.csv"); done
  "$tactus" bake "$examples/$name/scene.toml" -o "$work/$name.tactus" >"$work/log"
  "$tactus" touch "$work/$name.tactus" "${paths[@]}" --rate 1000 --output "$work/$name.csv" --bodies "$work/bodies.csv" >"$work/log"
  "$tactus" plot "$work/$name.csv" --bodies "$work/bodies.csv" --frames 6 --scene "$work/$name.tactus" -o "$pictures/$name.png"
}
strip grasp thumb finger
strip turned_ball thumb index middle
strip stack push
strip cup thumb finger

# Friction: every figure with its command, which the README repeats.
pictures=rendering/friction/pictures
mkdir -p "$pictures"
friction() {  # NAME ARGUMENT...
  "$tactus" "${@:2}" --figure "$pictures/$1.png" >"$work/log"
  echo "$pictures/$1.png"
}
for experiment in presliding lag break-away stick-slip hunting hysteresis; do
  friction "$experiment" friction --model lugre --experiment "$experiment"
done
friction karnopp_stick-slip friction --model karnopp --experiment stick-slip
friction motion friction --model lugre --motion "$examples/friction/record.csv"
friction push friction --model lugre --push "$examples/friction/push.csv" --mass-kg 1
friction fit fit "$examples/friction/record.csv"

# The Z-width of host_tools/certify/README.md.
pictures=host_tools/certify/pictures
mkdir -p "$pictures"
cp "$examples/devices/falcon.toml" "$work/"
"$tactus" certify "$work/falcon.toml" >"$work/log"
cp "$work/falcon.zwidth.png" "$pictures/falcon_zwidth.png"
echo "$pictures/falcon_zwidth.png"

# Two examples of the Python module, of host_tools/python/README.md.
pictures=host_tools/python/pictures
module="$(dirname "$tactus")/../python"
if [[ -d "$module" ]]; then
  mkdir -p "$pictures"
  for example in touch_mesh friction_models; do
    PYTHONPATH="$module" PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "host_tools/python/examples/$example.py" "$work" >"$work/log"
    cp "$work/$example.png" "$pictures/"
    echo "$pictures/$example.png"
  done
else
  echo "no Python module in $module: the pictures of host_tools/python stay as they are"
fi

# Ticks, of host_tools/explain/README.md.
pictures=host_tools/explain/pictures
mkdir -p "$pictures"
"$tactus" bake "$examples/gem/scene.toml" -o "$work/gem.tactus" >"$work/log"
"$tactus" touch "$work/gem.tactus" --path "$examples/gem/stroke.csv" -o "$work/gem.csv" --explain "$work/gem_steps.csv" >"$work/log"
"$tactus" plot "$work/gem_steps.csv" --explain --tick 870 --scene "$work/gem.tactus" -o "$work/" >"$work/log"
cp "$work/gem_steps_tick870.png" "$pictures/"
echo "$pictures/gem_steps_tick870.png"
explain() {  # RUN SCENE NAME ARGUMENT...
  "$tactus" plot "$work/$1_steps.csv" --explain --scene "$work/$2.tactus" "${@:4}" "$pictures/$3.png" >"$work/log"
  echo "$pictures/$3.png"
}
explain gem gem gem_strip --ticks 850..880/6 -o
for run in stroke gyroid; do  # heart.tactus is that of the path's figure
  "$tactus" touch "$work/heart.tactus" --path "$examples/heart/$run.csv" -o "$work/$run.csv" --explain "$work/${run}_steps.csv" >"$work/log"
done
explain gyroid heart gyroid_steps_tick109 --tick 109 -o
explain stroke heart heart_stroke --ticks 104..400/16 --animation

# The course's, which its README names.
course="$examples/course"
"$course/course.sh" "$tactus" >"$work/log"
grep -o '](pictures/[^)]*)' "$course/README.md" | tr -d '])(' | while read -r picture; do
  cp "$course/out/$(basename "$picture")" "$course/$picture"
  echo "$course/$picture"
done

# A connection graph and the changes of state on it, of host_tools/graph/README.md.
pictures=host_tools/graph/pictures
mkdir -p "$pictures"
"$tactus" inspect --graph "$examples/notch/notch.off" --picture "$pictures/notch_graph.png" >"$work/log"
echo "$pictures/notch_graph.png"
"$tactus" bake "$examples/notch/scene.toml" -o "$work/notch.tactus" >"$work/log"
"$tactus" touch "$work/notch.tactus" --path "$examples/notch/stroke.csv" -o "$work/notch.csv" --explain "$work/notch_steps.csv" >"$work/log"
"$tactus" plot "$work/notch_steps.csv" --transitions --scene "$work/notch.tactus" -o "$pictures/notch_transitions.png" >"$work/log"
echo "$pictures/notch_transitions.png"

# A needle, of rendering/needle/README.md: the force over the depth of the tip, and strips of ticks.
pictures=rendering/needle/pictures
mkdir -p "$pictures"
"$tactus" bake "$examples/epidural/scene.toml" -o "$work/epidural.tactus" >"$work/log"
for run in insert in_and_out; do
  "$tactus" touch "$work/epidural.tactus" --path "$examples/epidural/$run.csv" --rate 1000 -o "$work/$run.csv" --explain "$work/${run}_steps.csv" \
    >"$work/log"
done
over_depth() {  # NAME PLOT: columns 3 and 9 are tool_y_m and force_y_N
  gnuplot - <<END
set terminal pngcairo size 1000,560 font "sans,11"
set output "$pictures/$1.png"
set datafile separator ","
set xlabel "depth of the tip, mm"
set ylabel "force against the motion inward, N"
set xrange [-5:54]
set grid
set key top left
surfaces = "skin fat muscle ligament space"
depths = "0 5 20 45 50"
do for [i = 1:5] {
  set arrow from word(depths, i) + 0, graph 0 to word(depths, i) + 0, graph 1 nohead dashtype 2
  set label word(surfaces, i) at word(depths, i) + 0.6, graph 0.03 rotate by 90
}
plot $2
END
  echo "$pictures/$1.png"
}
over_depth epidural_force "'$work/insert.csv' every ::1 using (-1e3 * \$3):9 with lines linewidth 2 title 'in'"
over_depth epidural_in_and_out "'$work/in_and_out.csv' every ::1::6801 using (-1e3 * \$3):9 with lines linewidth 2 title 'in, and at rest', \
  '' every ::6801::12601 using (-1e3 * \$3):9 with lines linewidth 2 title 'out', \
  '' every ::12601 using (-1e3 * \$3):9 with lines linewidth 2 title 'in again'"
strip_of_needle() {  # RUN NAME TICKS
  "$tactus" plot "$work/$1_steps.csv" --explain --ticks "$3" --scene "$work/epidural.tactus" -o "$pictures/$2.png" >"$work/log"
  echo "$pictures/$2.png"
}
strip_of_needle insert epidural_strip 800..5301/643
strip_of_needle in_and_out withdrawal_strip 6800..12300/1100

# The demo's path, of the root README.
host_tools/bunny_mesh.sh "$work/bunny00.off"
cp "$examples/bunny/scene.toml" "$work/bunny.toml"
"$tactus" bake "$work/bunny.toml" -o "$work/bunny.tactus" >"$work/log"
"$tactus" sim "$work/bunny.tactus" --path "$examples/bunny/wish.csv" --output "$work/bunny.csv" >"$work/log"
"$tactus" plot "$work/bunny.csv" --scene "$work/bunny.tactus" -o "$work/" >"$work/log"
mkdir -p host_tools/pictures
cp "$work/bunny_path.png" host_tools/pictures/
echo host_tools/pictures/bunny_path.png

# The reach of an own arm, as host_tools/init begins it.
mkdir -p host_tools/reach/pictures
"$tactus" init arm "$work/lab" --yes >"$work/log"
"$tactus" inspect "$work/lab/device.toml" --figure host_tools/reach/pictures/arm_reach.png >"$work/log" 2>&1
echo host_tools/reach/pictures/arm_reach.png
