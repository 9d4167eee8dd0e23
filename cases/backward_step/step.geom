# A step down of height 1 at x = 0
4
wall open
4
-4 0
0 0
0 -1
10 -1
outlet open
2
10 -1
10 8
top open
2
10 8
-4 8
inlet open
2
-4 8
-4 0
