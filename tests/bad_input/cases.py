"""What must be refused: for each case its files, its arguments, the exit status and what the one line must say."""

from dataclasses import dataclass, field

SQUARE = "1\nbox\n4\n0 0\n4 0\n4 4\n0 4\n"
CASE = '[geometry]\nfile = "box.geom"\n[spacing]\nmin = 0.25\nmax = 1\n'

BAD_INPUT, WRONG_USAGE, OUTPUT_FAILED = 1, 2, 4


@dataclass
class Refusal:
    name: str
    says: list  # pieces of the lines on stderr
    status: int = BAD_INPUT
    warnings: int = 0  # lines before it
    geometry: str = SQUARE
    case: str = CASE
    arguments: list = field(default_factory=lambda: ["mesh", "case.toml", "-o", "out"])


def with_set(*assignments):
    arguments = ["mesh", "case.toml", "-o", "out"]
    for assignment in assignments:
        arguments += ["--set", assignment]
    return arguments


def geometry(name, text, *says):
    return Refusal(name, list(says), geometry=text)


def case_file(name, text, *says):
    return Refusal(name, list(says), case=text)


def warned(name, text, *says, warnings=1):
    return Refusal(name, list(says), warnings=warnings, geometry=text, arguments=["mesh", "case.toml", "-o", "out", "--max-cells", "3"])


def usage(name, arguments, *says):
    return Refusal(name, list(says), status=WRONG_USAGE, arguments=arguments)


GEOMETRIES = [
    geometry("not a count", "x\n", "box.geom:1:", "'x'"),
    geometry("empty file", "", "box.geom"),
    geometry("not a number", "1\nbox\n3\n0 0\n4 0\n4 x\n", "box.geom:6:", "'x'"),
    geometry("not finite", "1\nbox\n3\n0 0\n4 0\n4 nan\n", "box.geom:6:", "'nan'"),
    geometry("ends early", "1\nbox\n4\n0 0\n4 0\n4 4\n", "box.geom:6:", "ends here"),
    geometry("trailing text", SQUARE + "1 2\n", "box.geom:8:"),
    geometry("wrong count", "1\nbox\n3\n0 0\n4 0\n4 4\n0 4\n", "box.geom:7:"),
    geometry("two points", "1\nbox\n2\n0 0\n4 0\n", "box.geom:2:", "'box'", "three"),
    geometry("not watertight", "2\na open\n2\n0 0\n4 0\nb open\n3\n4 0\n4 4\n0 0.001\n", "'a'", "(0, 0)", "watertight"),
    geometry("crosses itself", "1\nbox\n4\n0 0\n4 4\n4 0\n0 4\n", "'box'", "(2, 2)"),
    geometry("touches another", SQUARE.replace("1\n", "2\n", 1) + "two\n3\n4 2\n6 1\n6 3\n", "box.geom:2:", "'box'", "'two'", "(box.geom:8)", "(4, 2)"),
    geometry("same loop twice", SQUARE.replace("1\n", "2\n", 1) + "two\n4\n0 0\n4 0\n4 4\n0 4\n", "'box'", "'two'"),
    warned("warning before an error of the reader", "1\nbox\n5\n0 0\n4 0\n4 0\n4 4\n1 -1\n", "'box'", "dropped 1 point", "neither cross nor touch"),
    warned("warning before an error of the mesher", "1\nbox\n4\n0 4\n4 4\n4 0\n0 0\n", "'box'", "had the wrong orientation", "--max-cells"),
    geometry("spike", "1\nbox\n5\n0 0\n4 0\n4 4\n4 9\n4 4\n", "'box'"),
]

CASES = [
    case_file("unknown key", CASE + "foo = 1\n", "case.toml:6:", "spacing.foo", "known here"),
    case_file("longer key", CASE + "maximum = 1\n", "case.toml:6:", "spacing.maximum", "do you mean 'max'?"),
    case_file("key of another table", "max = 1\n" + CASE, "case.toml:1:", "'max'", "do you mean 'spacing.max'?"),
    case_file("unknown table", CASE + "[spacings]\n", "case.toml:6:", "spacings"),
    case_file("later key", CASE + "[[block]]\nname = \"gas\"\n", "case.toml:6:", "block"),
    case_file("unknown threshold", CASE + "[adapt]\nthreshold = \"best\"\n", "case.toml:7:", "threshold", "deviation"),
    case_file("unknown indicator", CASE + "[adapt]\nindicator = \"gradients\"\n", "case.toml:7:", "indicator", "difference, gradient, hessian", "'gradient'?"),
    case_file("unknown condition", CASE + "[boundary.box]\nbc = \"walls\"\n", "case.toml:7:", "bc", "symmetry, interface, none", "'wall'?"),
    case_file("nodes without a number", CASE + "[adapt]\nthreshold = \"nodes\"\n", "case.toml:7:", "max_nodes"),
    case_file("half a pass", CASE + "[adapt]\npasses = 1.5\n", "case.toml:7:", "passes", "whole number"),
    case_file("passes of a command", CASE + "[adapt]\npasses = 1\n[solver]\nkind = \"command\"\ncommand = [\"true\"]\n", "case.toml:7:", "passes", "built-in"),
    case_file("passes in time", CASE + "[adapt]\npasses = 1\n[solver]\ntime = \"accurate\"\nend_time = 1.0\n", "case.toml:7:", "passes", "steady"),
    case_file("two kinds of field", CASE + "[adapt]\nvariable = { size = \"h\", error = \"e\" }\n", "case.toml:7:", "variable"),
    case_file("command without a program", CASE + "[solver]\nkind = \"command\"\n", "case.toml:6:", "command"),
    case_file("goal of a command", CASE + "[solver]\nkind = \"command\"\ncommand = [\"a\"]\ngoal = \"drag\"\n", "case.toml:9:", "goal"),
    case_file("goal with a far-field vortex", CASE + "[solver]\nfar_field = \"vortex\"\ngoal = \"drag\"\n", "case.toml:8:", "far_field"),
    case_file("far-field vortex in a fast stream", CASE + "[solver]\nfar_field = \"vortex\"\nmach = 1.2\n", "case.toml:7:", "needs mach < 1, but mach = 1.2"),
    case_file("a Mach number that the stream does not have", CASE + "[flow]\nmach = 0.5\nspeed = 1\npressure = 1\n", "case.toml:7: 'flow.mach'",
              "speed, density, pressure and gamma make"),
    case_file("unknown far field", CASE + "[solver]\nfar_field = \"swirl\"\n", "case.toml:7:", "far_field"),
    case_file("unknown way with unsteady flows", CASE + "[solver]\nunsteady = \"go_on\"\n", "case.toml:7:", "unsteady", "stop, carry_on"),
    case_file("carried on twice", CASE + "[solver]\ntime = \"accurate\"\nend_time = 1\nunsteady = \"carry_on\"\n", "case.toml:9:", "unsteady"),
    case_file("carried on at rest", CASE + "[solver]\nmach = 0\nunsteady = \"carry_on\"\n", "case.toml:8:", "unsteady", "mach"),
    case_file("endless flow-throughs", CASE + "[solver]\nunsteady = \"carry_on\"\nflow_throughs = 1e300\n", "case.toml:8:", "flow_throughs"),
    case_file("flow-throughs of a steady flow", CASE + "[solver]\nflow_throughs = 9\n", "case.toml:7:", "flow_throughs", "carry_on"),
    case_file("time step of a steady flow", CASE + "[solver]\ntime_step = 0.1\n", "case.toml:7:", "time_step"),
    case_file("steps without end", CASE + "[solver]\ntime = \"accurate\"\nend_time = 2\ntime_step = 1e-300\n", "case.toml:9:", "time_step", "2e+300 steps", "2e-07 or more"),
    case_file("time without end", CASE + "[solver]\ntime = \"accurate\"\nend_time = inf\n", "case.toml:8:", "end_time", "finite"),
    case_file("means over no time", CASE + "[solver]\ntime = \"accurate\"\nend_time = 2\naverage_from = 2\n", "case.toml:9:", "average_from", "end_time"),
    case_file("means of a flow continued in time", CASE + "[solver]\nunsteady = \"carry_on\"\naverage_from = 1\n", "case.toml:8:", "average_from", "second half"),
    case_file("unknown goal", CASE + "[solver]\ngoal = \"range\"\n", "case.toml:7:", "goal"),
    case_file("solution outside the folder", CASE + "[solver]\nsolution = \"../a.mesh\"\n", "case.toml:7:", "solution"),
    case_file("half a sweep", CASE + "[smooth]\nsweeps = 2.5\n", "case.toml:7:", "sweeps"),
    case_file("unknown objective", CASE + "[smooth]\nobjective = \"best\"\n", "case.toml:7:", "objective", "power"),
    case_file("wrong type", CASE + "gap = \"two\"\n", "case.toml:6:", "spacing.gap", "number"),
    case_file("out of range", CASE + "gradation = 3.0\n", "case.toml:6:", "spacing.gradation"),
    case_file("min above max", CASE.replace("0.25", "2"), "case.toml:4:", "spacing.min"),
    case_file("boundary matches nothing", CASE + "[boundary.hull]\nbc = \"wall\"\n", "case.toml:6:", "hull", "box"),
    case_file("pattern matches nothing", CASE + "[boundary.\"is_*\"]\nbc = \"wall\"\n", "case.toml:6:", "is_*"),
    case_file("not TOML", "[geometry\n", "case.toml:1:"),
    case_file("no geometry", "title = \"x\"\n", "case.toml", "geometry"),
    case_file("missing geometry file", CASE.replace("box", "none"), "case.toml:2: 'geometry.file'", "none.geom"),
    case_file("unknown suffix", CASE.replace("box.geom", "case.toml"), "'.toml' is not the suffix", ".geom"),
    case_file("far field too small", CASE.replace("[spacing]", "far_field = 2\n[spacing]"), "case.toml:3:", "far_field"),
    case_file("type", CASE + "[mesh]\ntype = \"voronoi\"\n", "case.toml:7:", "voronoi", "delaunay"),
    case_file("metric without norm", CASE + "[mesh]\ntype = \"metric\"\n[adapt]\ncycles = 1\n", "adapt.norm", "max_nodes"),
    case_file("unknown targets", CASE + "[smooth]\ntargets = \"flow\"\n", "case.toml:7:", "targets", "ideal, solution"),
    case_file("stretch without targets", CASE + "[smooth]\nstretch = 4\n", "case.toml:7:", "smooth.stretch", "targets = \"solution\""),
    case_file("no stretch", CASE + "[smooth]\ntargets = \"solution\"\nstretch = 1\n", "case.toml:8:", "smooth.stretch"),
    case_file("targets of a metric", CASE + "[mesh]\ntype = \"metric\"\n[smooth]\ntargets = \"solution\"\n", "case.toml:9:", "smooth.targets", "metric"),
    case_file("targets and parallelograms", CASE + "[mesh]\nquads = \"parallel\"\n[smooth]\ntargets = \"solution\"\n", "case.toml:9:",
              "smooth.targets", "delaunay"),
    case_file("targets without sweeps", CASE + "[smooth]\nsweeps = 0\ntargets = \"solution\"\n", "case.toml:8:", "smooth.targets", "sweeps"),
    case_file("targets of a size", CASE + "[smooth]\ntargets = \"solution\"\n[adapt]\nvariable = { size = \"h\" }\n", "case.toml:7:", "smooth.targets",
              "adapt.variable"),
    case_file("metric and mirror", CASE + "[mesh]\ntype = \"metric\"\nmirror = \"x\"\n", "case.toml:8:", "half"),
    case_file("root too small", CASE + "[mesh]\nroot = [0, 0, 2, 1, 1]\n", "root"),
    case_file("min too small for the tree", CASE.replace("0.25", "1e-12"), "min"),
    case_file("unknown format", CASE + "[output]\nformats = [\"xyz\"]\n", "case.toml:7:", "xyz", "vtu, pvtu, vtkhdf, su2, fluent.msh, msh"),
    case_file("prefix with a suffix", CASE + "[output]\nprefix = \"a.cgns\"\n", "case.toml:7:", "without .cgns"),
    case_file("pattern without quotes", CASE + "[boundary.is_*]\n", "case.toml:6:", "quote it"),
    case_file("text without quotes", CASE + "[boundary.box]\nbc = wall\n", "case.toml:7:", "put text in quotes: \"wall\""),
    Refusal("--set without a source", ["--set source.0.spacing=1:", "[[source]]"], arguments=with_set("source.0.spacing=1")),
    Refusal("bad --set value", ["--set spacing.min=-1:", "spacing.min"], arguments=with_set("spacing.min=-1")),
    Refusal("bad second value of one --set", ["--set spacing.min=-1:", "spacing.min"],
            arguments=["mesh", "--set", "spacing.max=2", "spacing.min=-1", "case.toml", "-o", "out"]),
    Refusal("unknown --set key", ["--set spacing.foo=1:", "unknown key"], arguments=with_set("spacing.foo=1")),
    Refusal("adapt.min deeper than trees go", ["adapt.min = 1e-12 is too small", "make it larger"],
            case=CASE + "[boundary.box]\nbc = \"wall\"\n[adapt]\nmin = 1e-12\n[solver]\n", arguments=["adapt", "case.toml", "-o", "out"]),
    Refusal("--set without =", ["--set spacing.min:"], arguments=with_set("spacing.min")),
    Refusal("case file without an end", ["/dev/zero: is a device"], arguments=["mesh", "/dev/zero", "-o", "out"]),
    Refusal("name of the case file too long", ["File name too long"], arguments=["mesh", "x" * 300, "-o", "out"]),
    Refusal("missing case file", ["none.toml"], arguments=["mesh", "none.toml", "-o", "out"]),
]

USAGES = [
    Refusal("smooth: missing mesh", ["none.mesh"], arguments=["smooth", "none.mesh", "-o", "out.mesh"]),
    Refusal("smooth: unknown format", ["out.vtk", ".su2"], arguments=["smooth", "none.mesh", "-o", "out.vtk"]),
    usage("smooth: unknown method", ["smooth", "none.mesh", "-o", "out.mesh", "--method", "best"], "--method"),
    usage("smooth: no output", ["smooth", "none.mesh"], "--output"),
    usage("remesh: no tree", ["remesh", "case.toml", "--solution", "a.mesh"], "--tree is required", "PREFIX.tree.h5"),
    usage("no command", [], "a command is missing", "--help"),
    usage("unknown command", ["mash", "case.toml"], "'mash' is no command", "mesh, smooth, adapt, solve, remesh, check, plot", "--help"),
    usage("unknown type", ["mesh", "case.toml", "-o", "out", "--type", "voronoi"], "--type", "voronoi", "hybrid,delaunay"),
    usage("prefix with the suffix of a format", ["mesh", "case.toml", "-o", "out.mesh"], "out.mesh", "without .mesh"),
    usage("no case file", ["mesh"], "case"),
    usage("unknown option", ["mesh", "case.toml", "--nonsense"], "--nonsense"),
]

OUTPUTS = [
    Refusal("missing folder", ["none/out"], OUTPUT_FAILED, arguments=["mesh", "case.toml", "-o", "none/out"]),
    Refusal("missing folder of the geometry", ["none/o.geom"], OUTPUT_FAILED,
            arguments=["mesh", "case.toml", "-o", "out", "--geometry-out", "none/o.geom"]),
    Refusal("name too long", ["File name too long", "shorter name"], OUTPUT_FAILED, arguments=["mesh", "case.toml", "-o", "x" * 250]),
    Refusal("a folder in the way", ["taken.mesh"], OUTPUT_FAILED, arguments=["mesh", "case.toml", "-o", "taken"]),
]

ALL = GEOMETRIES + CASES + USAGES + OUTPUTS
