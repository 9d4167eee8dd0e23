#!/usr/bin/env python3
"""Fails when a GoogleTest can pass without one assertion: all of them stand in loops behind a `continue` or within an `if`. Such a test must
count what it compared, and assert the count behind the loop. What only the root rank does (`if (!world().is_root()) continue;`) always happens.

    loops_count.py [REPOSITORY]
"""
import re
import sys
from pathlib import Path

LITERAL = re.compile(r'//[^\n]*|/\*.*?\*/|R"(\w*)\(.*?\)\1"|"(?:[^"\\\n]|\\.)*"|(?<!\w)\'(?:[^\'\\\n]|\\.)+\'', re.S)
TEST = re.compile(r"^TEST(?:_F|_P)?\s*\(\s*(\w+)\s*,\s*(\w+)\s*\)\s*\{", re.M)
ASSERTION = re.compile(r"\b(?:EXPECT|ASSERT)_\w+|\b(?:FAIL|ADD_FAILURE)\b|\b(?:expect|require|says|check|refuse)\w*\s*\(")
STATEMENT = re.compile(r"\b(for|while|if)\s*(?:constexpr\s*)?\(|\bfor_each\w*\s*\(")
CLOSING = {"(": ")", "{": "}"}


def blank(text):
    """Without comments and literals, in the same places."""
    return LITERAL.sub(lambda found: re.sub(r"[^\n]", " ", found[0]), text)


def end_of_bracket(text, begin):
    opening, closing, depth = text[begin], CLOSING[text[begin]], 0
    for at in range(begin, len(text)):
        depth += (text[at] == opening) - (text[at] == closing)
        if depth == 0:
            return at
    raise ValueError("a bracket without its end")


def end_of_statement(text, begin):
    while text[begin].isspace():
        begin += 1
    if text[begin] == "{":
        return end_of_bracket(text, begin)
    if head := STATEMENT.match(text, begin):
        return end_of_statement(text, end_of_bracket(text, head.end() - 1) + 1)
    depth = 0
    while begin < len(text) and (text[begin] != ";" or depth):
        depth += (text[begin] in "({[") - (text[begin] in ")}]")
        begin += 1
    return begin


def loops_and_ifs(body):
    loops, ifs = [], []
    for head in STATEMENT.finditer(body):
        end = end_of_bracket(body, head.end() - 1)
        if head[1]:
            end = end_of_statement(body, end + 1)
        if head[1] != "if":
            loops.append((head.start(), end))
        elif "is_root()" not in body[head.start():body.index("\n", head.start())]:
            ifs.append((head.start(), end))
    return loops, ifs


def may_be_skipped(body):
    """The parts of a test's body that may never run."""
    loops, ifs = loops_and_ifs(body)
    skipped = [part for part in ifs if any(begin < part[0] < end for begin, end in loops)]
    for found in re.finditer(r"\bcontinue\s*;", body):
        around = [loop for loop in loops if loop[0] < found.start() < loop[1]]
        line = body[body.rindex("\n", 0, found.start()):found.start()]
        if around and "is_root()" not in line:
            skipped.append((found.start(), max(around)[1]))
    return skipped


def faults_in(path, root):
    text = blank(path.read_text())
    for test in TEST.finditer(text):
        body = text[test.end():end_of_bracket(text, test.end() - 1)] + "\n"
        assertions = [found.start() for found in ASSERTION.finditer(body)]
        skipped = may_be_skipped(body)
        if assertions and all(any(begin <= at <= end for begin, end in skipped) for at in assertions):
            line = text.count("\n", 0, test.start()) + 1
            yield f"{path.relative_to(root)}:{line}: {test[1]}.{test[2]} may pass without an assertion; count what it compares"


def main():
    root = Path(sys.argv[1] if len(sys.argv) > 1 else Path(__file__).parents[2]).resolve()
    sources = sorted((root / "tests").rglob("*.cpp"))
    faults = [fault for source in sources for fault in faults_in(source, root)]
    print("\n".join(faults) if faults else f"the tests of {len(sources)} sources assert something")
    return 1 if faults or not sources else 0


if __name__ == "__main__":
    sys.exit(main())
