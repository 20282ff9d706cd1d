// The gnuplot scripts of the figures of ticks (tick_figure.h), as formats of fmt.
#pragma once

#include <string_view>

namespace tactus::host {

// The title, and the line of facts below it.
inline constexpr std::string_view kTickHead = R"gnuplot(
set border 3 linecolor "#555555"
set tics nomirror out textcolor "#333333"
set size ratio -1
set clip two
set label 1 {title} at screen {left:.5f},{title_y:.5f} left font ",18" textcolor "#111111" noenhanced
set label 2 {facts} at screen {left:.5f},{facts_y:.5f} left textcolor "#333333" noenhanced
)gnuplot";

// One view, of the data blocks whose names end in _{s}.
inline constexpr std::string_view kTickView = R"gnuplot(
set lmargin at screen {left:.6f}
set rmargin at screen {right:.6f}
set bmargin at screen {bottom:.6f}
set tmargin at screen {top:.6f}
set xrange [{x0:.6g}:{x1:.6g}]
set yrange [{y0:.6g}:{y1:.6g}]
set xlabel {xlabel} textcolor "#333333"
set ylabel {ylabel} textcolor "#333333" offset 0.5
set label 5 {title} at graph 0.5,1.0 center offset 0,0.9 textcolor "#111111" noenhanced
unset key
plot {behind}$cut_{s} using 1:2 with lines linecolor "#9a9a9a" linewidth 4, \
     $held_{s} using 1:2 with lines linecolor "#17406d" linewidth 1.8, \
     $loose_{s} using 1:2 with lines linecolor "#7f9cc0" linewidth 1 dashtype 3, \
     $static_{s} using 1:2 with lines linecolor "#b8860b" linewidth 1.6, \
     $dynamic_{s} using 1:2 with lines linecolor "#b8860b" linewidth 1.6 dashtype 2, \
     $spring_{s} using 1:2 with lines linecolor "#4c9a78" linewidth 1.8 dashtype 4, \
     $missed_{s} using 1:2:3:4 with vectors nohead linecolor "#d0421b" linewidth 1 dashtype 3, \
     $goals_{s} using 1:2 with points pointtype 4 pointsize 1.5 linecolor "#d0421b", \
     $ball_{s} using 1:2:3 with circles fillstyle empty linecolor "#d0421b" linewidth 1.4, \
     $moves_{s} using 1:2:3:4 with vectors filled head size screen 0.008,18 linecolor "#d0421b" linewidth 2.2, \
     $under_{s} using 1:2 with points pointtype 13 pointsize 1.8 linecolor "#555555", \
     $before_{s} using 1:2 with points pointtype 6 pointsize 1.8 linecolor "#d0421b" linewidth 2, \
     $proxy_{s} using 1:2 with points pointtype 7 pointsize 1.6 linecolor "#d0421b", \
     $tool_{s} using 1:2 with points pointtype 7 pointsize 1.8 linecolor "#111111", \
     $numbers_{s} using 1:2:3 with labels center offset 0,1.1 textcolor "#8f2a12"
unset label
unset colorbox
)gnuplot";

// The key has a panel of its own.
inline constexpr std::string_view kTickKey = R"gnuplot(
set lmargin at screen {left:.6f}
set rmargin at screen {right:.6f}
set bmargin at screen {bottom:.6f}
set tmargin at screen {top:.6f}
set size noratio
unset border
unset tics
unset xlabel
unset ylabel
set xrange [0:1]
set yrange [0:1]
set key center center {direction} width -1 samplen 2.5 textcolor "#333333" noenhanced
plot )gnuplot";

// The key's entries for ticks on meshes and primitives.
inline constexpr std::string_view kMeshEntries = R"gnuplot(\
     9 with lines linecolor "#9a9a9a" linewidth 4 title 'surface, cut', \
     9 with lines linecolor "#17406d" linewidth 1.8 title 'active plane', \
     9 with lines linecolor "#7f9cc0" linewidth 1 dashtype 3 title 'plane that is not active', \
     9 with lines linecolor "#b8860b" linewidth 1.6 title 'friction cone, static', \
     9 with lines linecolor "#b8860b" linewidth 1.6 dashtype 2 title 'dynamic', \
     )gnuplot";

// The entries of the key for ticks on a formula.
inline constexpr std::string_view kFieldEntries = R"gnuplot(\
     9 with lines linecolor "#111111" linewidth 3 title 'F = 0, the surface', \
     9 with lines linecolor "#e8bf3a" linewidth 6 title 'tolerance: in contact', \
     9 with lines linecolor "#17406d" linewidth 1.8 title 'tangent plane', \
     )gnuplot";

// The entries of the key for all ticks; they come last.
inline constexpr std::string_view kStepEntries = R"gnuplot(\
     9 with lines linecolor "#4c9a78" linewidth 1.8 dashtype 4 title 'spring', \
     9 with lines linecolor "#d0421b" linewidth 2.2 title 'move', \
     9 with linespoints pointtype 4 pointsize 1.5 linecolor "#d0421b" linewidth 1 dashtype 3 title 'sub-goal not reached', \
     9 with points pointtype 6 pointsize 1.8 linecolor "#d0421b" linewidth 2 title '{before}', \
     9 with points pointtype 7 pointsize 1.6 linecolor "#d0421b" title 'proxy (god-object)', \
     9 with points pointtype 13 pointsize 1.8 linecolor "#555555" title 'surface contact point', \
     9 with points pointtype 7 pointsize 1.8 linecolor "#111111" title 'tool (HIP)'
)gnuplot";

}  // namespace tactus::host
