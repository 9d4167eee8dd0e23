# A plate from x = 0 to 2 behind a symmetry line
5
symmetry open
2
-1 0
0 0
wall open
2
0 0
2 0
outlet open
2
2 0
2 1
top open
2
2 1
-1 1
inlet open
2
-1 1
-1 0
