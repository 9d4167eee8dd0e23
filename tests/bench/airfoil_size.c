/* The size function of case B for Shewchuk's Triangle, which peers.py --sized runs: edges of AIRFOIL_SIZE (a variable of the environment) at NACA 0012,
   longer by 0.3 of the distance from it. Build it beside triangle.c, and keep "sized" in the program's name:

       cc -O2 -ffp-contract=off -DLINUX -DEXTERNAL_TEST -o triangle_sized triangle.c airfoil_size.c -lm
*/
#include <math.h>
#include <stdlib.h>

static double half_thickness(double x) {
  return 0.6 * (0.2969 * sqrt(x) - 0.1260 * x - 0.3516 * x * x + 0.2843 * x * x * x - 0.1036 * x * x * x * x);
}

/* Nearly: along y over the chord, else from its nearer end. */
static double distance(double x, double y) {
  const double beside = x < 0 ? -x : x > 1 ? x - 1 : 0, over = fabs(y) - (beside > 0 ? 0 : half_thickness(x));
  return hypot(beside, over > 0 ? over : 0);
}

int triunsuitable(double* origin, double* destination, double* apex, double area) {
  static double at_wall = 0;
  double size;
  if (at_wall == 0) {
    const char* text = getenv("AIRFOIL_SIZE");
    at_wall = text ? atof(text) : 1e-3;
  }
  size = at_wall + 0.3 * distance((origin[0] + destination[0] + apex[0]) / 3, (origin[1] + destination[1] + apex[1]) / 3);
  return area > 0.4330127018922193 * size * size;
}
