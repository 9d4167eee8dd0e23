"""From a C++ source to the same source with every mutation behind a switch (mutants.hpp). It reads our own clang-formatted text, not
C++ at large: a binary operator has a space on either side, a template's bracket has none."""
import re
from dataclasses import dataclass

OPERATORS = {"<": ("Less", "<="), "<=": ("LessEqual", "<"), ">": ("Greater", ">="), ">=": ("GreaterEqual", ">"), "==": ("Equal", "!="),
             "!=": ("Unequal", "=="), "+": ("Plus", "-"), "-": ("Minus", "+"), "*": ("Times", "/"), "/": ("Divided", "*")}
BINARY = re.compile(r"(?<=[\w)\]}] )(<=|>=|==|!=|[-<>+*/])(?=\s)")
LITERAL = re.compile(r"(?<![\w.'])(\d[\d']*(?:\.\d*)?(?:[eE][-+]?\d+)?)([uUlLfF]*)(?![\w.'>])")
HIDDEN = re.compile(r'//[^\n]*|/\*.*?\*/|R"\((?:.*?)\)"|"(?:\\.|[^"\\\n])*"|(?<!\w)\'(?:\\.|[^\'\\\n])+\'|^[ \t]*#(?:\\\n|[^\n])*', re.S | re.M)
# Never mutated: our own assertions, what only the compiler sees, and declarations that look like expressions.
SPARED = re.compile(r"\b(QUADLOOP_REQUIRE|static_assert|requires|operator|decltype)\b|\b(static constexpr|enum|virtual|template|case)\b")
CONSTANT = re.compile(r"^ *(?:static |inline )*const(?:expr)? [\w:<>, ]+ \w+(?: =|\{)", re.M)
OPEN, CLOSE = "([{", ")]}"


@dataclass
class Mutant:
    line: int
    key: str  # where, in words that a moved line keeps
    edits: list  # (begin, end, rank, text): the text takes the place of what stands between


def blank(text):
    return HIDDEN.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def matching(text, begin):
    """The place of the bracket that closes the one at `begin`."""
    depth = 0
    for i in range(begin, len(text)):
        depth += (text[i] in OPEN) - (text[i] in CLOSE)
        if depth == 0:
            return i
    raise ValueError("unbalanced brackets")


def spared_ranges(code):
    for match in SPARED.finditer(code):
        if match[1] in ("QUADLOOP_REQUIRE", "static_assert", "decltype"):
            yield match.start(), matching(code, code.index("(", match.end()))
        elif match[2] in ("static constexpr", "enum", "virtual"):
            yield match.start(), code.index(";", match.end())
        else:
            yield match.start(), match.end() + re.search(r"[>:\n]|$", code[match.end():]).end()


def operand_bounds(code, operator_begin, operator_end):
    """The operands of the && or || there, as (begin, end, what stands left, what stands right)."""
    ends = re.compile(r"[;,?]|&&(?= |\n)|\|\||(?<!:):(?!:)|(?<![=!<>+\-*/|&^%])=(?![=])|\breturn\b")

    def scan_right(i):
        while i < len(code) and code[i] not in CLOSE and not ends.match(code, i):
            i = matching(code, i) + 1 if code[i] in OPEN else i + 1
        return i

    def scan_left(i):
        depth = 0
        while i > 0:
            c = code[i - 1]
            if depth == 0 and (c in OPEN or c in ";,?" or code[i - 2:i] in ("&&", "||") or code[max(0, i - 7):i] == " return"
                               or (c == ":" and code[i - 2] != ":" and code[i] != ":")
                               or (c == "=" and code[i - 2] in " +-*/|&^%" and code[i] in " \n")):
                break
            depth += (c in CLOSE) - (c in OPEN)
            i -= 1
        return i

    def trimmed(begin, end):
        while begin < end and code[begin].isspace():
            begin += 1
        while end > begin and code[end - 1].isspace():
            end -= 1
        return begin, end

    return trimmed(scan_left(operator_begin), operator_begin), trimmed(operator_end, scan_right(operator_end))


def places(code):
    """Each mutation of blanked code: (begin, end, what is shown instead, the edits as functions of an id)."""
    for m in BINARY.finditer(code):
        name, other = OPERATORS[m[1]]
        yield m.start(), m.end(), other, lambda i, m=m, n=name: [(m.start(), m.end(), 2, f"{m[1]} ::quadloop_mutant::{n}<{i}>{{}} {m[1]}")]
    clauses = {}
    for m in re.finditer(r"(?<= )(&&|\|\|)(?=\s)", code):
        for bounds in operand_bounds(code, m.start(), m.end()):
            if bounds[1] > bounds[0]:
                clauses[bounds] = "true" if m[1] == "&&" or clauses.get(bounds) == "true" else "false"
    for (begin, end), neutral in clauses.items():
        start = "(::quadloop_mutant::on({}) || (" if neutral == "true" else "(!::quadloop_mutant::on({}) && ("
        yield begin, end, neutral, lambda i, b=begin, e=end, s=start: [(b, b, 1, s.format(i)), (e, e, 0, "))")]
    for m in re.finditer(r"\b(?:if|while) \(", code):
        begin, end = m.end(), matching(code, m.end() - 1)
        condition = code[begin:end]
        one_comparison = re.fullmatch(r"[^&|?]* [=!]= [^&|?=!]*", condition) and "(" not in condition  # == and != are mutated anyway
        if not one_comparison and not re.search(r";|[^=!<>]=[^=]", condition) and not any(begin <= b and e <= end for b, e in clauses):
            yield begin, end, "not", lambda i, b=begin, e=end: [
                (b, b, 1, f"::quadloop_mutant::on({i}) != static_cast<bool>("), (e, e, 0, ")")]
    initialised = [(m.start(), code.index(";", m.end())) for m in CONSTANT.finditer(code)]
    for m in LITERAL.finditer(code):
        before = code[max(0, m.start() - 3):m.start()]
        sentinel = before[-1:] == "-" and before[-2:-1] in " ({"  # -1 for none: any negative number is
        if sentinel or before[-1:] == "<" or (before[-1:] == "[" and code[m.end()] == "]") or (m[1] == "1" and before in (" + ", " - ")):
            continue
        number = m[1].replace("'", "")
        after = str(int(number) + 1) if number.isdigit() else str(float(number) * 2 or 1.0)
        kind = "constant" if any(b < m.start() < e for b, e in initialised) else "number"
        yield m.start(), m.end(), after + m[2], lambda i, m=m, a=after, k=kind: [
            (m.start(), m.end(), 2, f"::quadloop_mutant::{k}<{i}>({m[0]}, {a}{m[2]})")]


def constants(code):
    """Where `constexpr` stands before a named constant, with its names: what must become `const` for its literals to be switched."""
    for m in re.finditer(r"(?<!static )\bconstexpr\b(?= [\w:]+(<[^;()]*?>)? (\w+)( =|\{))", code):
        yield m.start(), m.end(), re.findall(r"\b(\w+)(?: =|\{)", code[m.end():code.index(";", m.end())])


def find_mutants(name, text, first_id):
    """All mutants of a source, in the order of their places; the ids count from first_id."""
    code = blank(text)
    spared = list(spared_ranges(code))
    found = sorted((p for p in places(code) if not any(b <= p[0] < e for b, e in spared)), key=lambda p: (p[0], p[1]))
    mutants = []
    for number, (begin, end, after, edits) in enumerate(found, first_id):
        left, right = text.rfind("\n", 0, begin) + 1, text.find("\n", end)
        before = text[begin:end]
        shown = f"{text[left:begin]}«{before} -> {'not' if after == 'not' else after}»{text[end:right]}"
        mutants.append(Mutant(text.count("\n", 0, begin) + 1, f"{name}: {' '.join(shown.split())}", edits(number)))
    return mutants


def rewritten(text, mutants, kept_constants=()):
    """The source with these mutants behind their switches. Lines stay where they are."""
    edits = [edit for mutant in mutants for edit in mutant.edits]
    for begin, end, names in constants(blank(text)):
        if not set(names) & set(kept_constants):
            edits.append((begin, end, 2, "const"))
    parts, place = [], 0
    # At one place: closing before opening, a longer opening first, what is replaced last.
    for begin, end, _, new in sorted(edits, key=lambda e: (e[0], e[2])):
        parts += [text[place:begin], new]
        place = end
    return "".join(parts) + text[place:]
