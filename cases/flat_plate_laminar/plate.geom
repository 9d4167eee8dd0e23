5
ahead open
2
-1 0
0 0
plate open
2
0 0
1 0
outlet open
2
1 0
1 1
top open
2
1 1
-1 1
inlet open
2
-1 1
-1 0
