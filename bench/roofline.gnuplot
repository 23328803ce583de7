# roofline.svg and roofline.png of `brume bench --roofline`. brume puts before it: plot_title, svg_file, png_file and
# the data block $rows (a line a row: name, share of what the device allows, what limits it, rate).
stats $rows using 2 nooutput
n = STATS_records
floor_share = 10 ** floor(log10(STATS_min) - 0.5)
set logscale x 10
set xrange [floor_share:3]
set yrange [n - 0.3:-0.7]
set format x "%g"
set xlabel "share of what the device allows"
set title plot_title noenhanced
set ytics noenhanced scale 0
set grid x lc rgb "#dddddd" lt 1
set border 1 lc rgb "#111111"
set key tmargin center horizontal noenhanced
set style fill solid 1.0 noborder
array names[3] = ["copy", "fma", "loads"]
array titles[3] = ["limit: bytes copied", "limit: multiply-adds", "limit: loads of pairs"]
array colors[3] = [0x8fbc5a, 0xd9822b, 0x0b5394]
set arrow from 1, graph 0 to 1, graph 1 nohead dt 2 lc rgb "#111111"
bar(i) = strcol(3) eq names[i] ? column(2) : NaN
draw = 'plot for [i=1:3] $rows using (bar(i)):0:(floor_share):(bar(i)):($0 - 0.36):($0 + 0.36):ytic(1) \
  with boxxyerror lc rgb colors[i] title titles[i], \
  $rows using 2:0:4 with labels left offset 0.6, 0 noenhanced notitle'
set terminal svg size 1000, 760 font "sans-serif,13" background "#ffffff"
set output svg_file
eval draw
set terminal pngcairo size 1500, 1140 font "sans-serif,14" linewidth 1.5
set output png_file
eval draw
set output
