# chart.svg and chart.png of `brume chart`. brume puts before it: chart_title, floor (the exact picture's own error),
# methods (their names), marks (a number for each, the same in all charts), svg_file, png_file, n_peers and the data
# blocks $points (two columns, seconds and error; an index for each method), $front and $peers (with a third column, the
# name).
set logscale xy
set format "%g"
set xlabel "seconds of a render"
set ylabel "error: relative RMSE"
set title chart_title noenhanced
set key outside right top Left reverse noenhanced
set grid lc rgb "#dddddd" lt 1
set border lc rgb "#111111"
set arrow from graph 0, first 1.0/255 to graph 1, first 1.0/255 nohead dt 2 lw 1.5 lc rgb "#111111" back
set label "1/255" at graph 0.005, first 1.0/255 offset 0, 0.5 back
set arrow from graph 0, first 1e-3 to graph 1, first 1e-3 nohead dt 2 lw 1.5 lc rgb "#111111" back
set label "1e-3" at graph 0.005, first 1e-3 offset 0, 0.5 back
if (floor > 0) {
  set yrange [floor / 3:]
  set object 1 rect from graph 0, graph 0 to graph 1, first floor fc rgb "#eeeeee" fs solid noborder behind
  set label "the exact picture's own error" at graph 0.995, first floor right offset 0, -0.7 back
}
# One shape and one brightness each: they are told apart in grey. The front is the thick line.
array shapes[13] = [9, 12, 4, 8, 10, 6, 14, 1, 2, 3, 5, 7, 11]
array colors[13] = [0x4a7fd0, 0x000000, 0x0b5394, 0xd9822b, 0x8fbc5a, 0x7b1fa2, 0xc2185b, 0x4db6ac, 0xf2c14e, \
  0x5d4037, 0x9e9e9e, 0x2e7d32, 0x8c2d04]
draw = 'plot $front using 1:2 with lines lw 4 lc rgb "#999999" title "nothing quicker and closer", \
  for [i=1:words(methods)] $points index i-1 using 1:2 \
    with points pt shapes[word(marks, i) + 0] ps 1.3 lw 1.6 lc rgb colors[word(marks, i) + 0] \
    title word(methods, i)'
if (n_peers > 0) {
  draw = draw.', $peers using 1:2 with points pt 7 ps 1.6 lc rgb "#111111" title "other programs", \
    $peers using 1:2:3 with labels left offset 1, 0 noenhanced notitle'
}
set terminal svg size 1000, 640 font "sans-serif,13" background "#ffffff"
set output svg_file
eval draw
set terminal pngcairo size 1500, 960 font "sans-serif,14" linewidth 1.5 pointscale 1.4
set output png_file
eval draw
set output
