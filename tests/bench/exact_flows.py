"""Exact relations of a perfect gas of gamma 1.4 that the table of flows is measured by (NACA Report 1135). Radians."""
import math

GAMMA = 1.4


def rising_root(function, low, high):
    """Where a function that rises from below 0 to above it is 0."""
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if function(middle) < 0 else (low, middle)
    return 0.5 * (low + high)


def deflection(mach, shock):
    """By an oblique shock at this angle to the stream."""
    normal = (mach * math.sin(shock)) ** 2
    return math.atan(2 / math.tan(shock) * (normal - 1) / (mach ** 2 * (GAMMA + math.cos(2 * shock)) + 2))


def through_shock(mach, turn):
    """Mach number and pressure ratio behind the weak oblique shock that turns the stream by that much."""
    lowest = math.asin(1 / mach)
    strongest = max((lowest + (math.pi / 2 - lowest) * k / 1000 for k in range(1001)), key=lambda shock: deflection(mach, shock))
    shock = rising_root(lambda angle: deflection(mach, angle) - turn, lowest, strongest)
    normal = (mach * math.sin(shock)) ** 2
    behind = math.sqrt((1 + 0.5 * (GAMMA - 1) * normal) / (GAMMA * normal - 0.5 * (GAMMA - 1))) / math.sin(shock - turn)
    return behind, 1 + 2 * GAMMA / (GAMMA + 1) * (normal - 1)


def prandtl_meyer(mach):
    root = math.sqrt((GAMMA + 1) / (GAMMA - 1))
    return root * math.atan(math.sqrt(mach ** 2 - 1) / root) - math.atan(math.sqrt(mach ** 2 - 1))


def isentropic(mach):
    """Total over static pressure."""
    return (1 + 0.5 * (GAMMA - 1) * mach ** 2) ** (GAMMA / (GAMMA - 1))


def through_fan(mach, turn):
    """Mach number and pressure ratio behind an expansion."""
    behind = rising_root(lambda m: prandtl_meyer(m) - prandtl_meyer(mach) - turn, mach, 50)
    return behind, isentropic(mach) / isentropic(behind)


def turned(mach, turn):
    """Into the stream where the turn is positive."""
    return through_shock(mach, turn) if turn > 0 else through_fan(mach, -turn) if turn < 0 else (mach, 1.0)


def pressure_coefficient(ratio, mach):
    return (ratio - 1) / (0.5 * GAMMA * mach ** 2)


def stagnation(mach):
    """Pressure of the gas brought to rest over that of the free stream, behind a normal shock where it is faster than sound."""
    if mach <= 1:
        return isentropic(mach)
    ratio = 1 + 2 * GAMMA / (GAMMA + 1) * (mach ** 2 - 1)
    return ratio * isentropic(math.sqrt((1 + 0.5 * (GAMMA - 1) * mach ** 2) / (GAMMA * mach ** 2 - 0.5 * (GAMMA - 1))))


def ramp_forces(mach, degrees):
    """CL and CD of a ramp 1 long along x below the stream."""
    turn = math.radians(degrees)
    coefficient = pressure_coefficient(through_shock(mach, turn)[1], mach)
    return -coefficient, coefficient * math.tan(turn)


def diamond_forces(mach, half_angle, alpha):
    """CL and CD of a diamond of chord 1: shocks and expansions that do not meet before the trailing edge. Degrees."""
    half, incidence = math.radians(half_angle), math.radians(alpha)
    normal_force = axial_force = 0
    for side in (1, -1):  # lower, upper
        front, ratio = turned(mach, half + side * incidence)
        back = ratio * turned(front, -2 * half)[1]
        front_force, back_force = pressure_coefficient(ratio, mach), pressure_coefficient(back, mach)
        normal_force += side * 0.5 * (front_force + back_force)
        axial_force += 0.5 * math.tan(half) * (front_force - back_force)
    return (normal_force * math.cos(incidence) - axial_force * math.sin(incidence),
            normal_force * math.sin(incidence) + axial_force * math.cos(incidence))
