"""Lift and drag of the NACA 0012 at Mach 0.8 and 1.25 degrees on the finest meshes (docs/notes/adaptation-studies.md), and how near the cycles of a run come."""

FINEST = {"cl": 0.3478, "cd": 0.02244}


def errors(record):
    return {key: record[key] / FINEST[key] - 1 for key in FINEST}


def first_within(cycles):
    """The first cycle from which on lift and drag stay within 0.5 %."""
    holds = [max(map(abs, errors(cycle).values())) <= 0.005 for cycle in cycles]
    return next((k for k in range(len(cycles)) if all(holds[k:])), None)
