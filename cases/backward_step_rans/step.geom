# A channel of height 8 with a step down of height 1 at x = 0
9
symmetry_below open
2
-130 0
-110 0
plate open
2
-110 0
0 0
step open
2
0 0
0 -1
floor open
2
0 -1
15 -1
channel open
2
15 -1
50 -1
outlet open
2
50 -1
50 8
top open
2
50 8
-110 8
symmetry_above open
2
-110 8
-130 8
inlet open
2
-130 8
-130 0
