# a channel of 8 by 4, walked with its inside to the left
4
bottom open
2
-2 -2
6 -2
outlet open
2
6 -2
6 2
top open
2
6 2
-2 2
inlet open
2
-2 2
-2 -2
