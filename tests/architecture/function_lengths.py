"""Finds the functions of a C, C++ or Rust source and how many lines each takes.

A tokenizer blanks comments and literals, and a stack of braces tells functions from the rest: a
brace opens a function where the text before it, since the last `;`, `{` or `}`, ends a parameter
list. Namespaces, classes, enums and initializers are transparent; what stands inside a function,
lambdas included, counts for that function.
"""

import re

BLANKED = re.compile(
    r'//[^\n]*|/\*.*?\*/'                                        # comments
    r'|\bR"([^\s()\\]{0,16})\(.*?\)\1"'                          # a raw string of C++
    r'|\br(#*)".*?"\2'                                           # a raw string of Rust
    r'|"(?:\\.|[^"\\\n])*"'                                      # a string
    r"|(?<![0-9A-Za-z_])'(?:\\[^\n]{1,10}?|[^'\\\n])'"           # a character
    r'|^[ \t]*#(?:[^\n]*\\\n)*[^\n]*',                           # a preprocessor directive
    re.DOTALL | re.MULTILINE)

# A parameter list, and what may stand between it and the body.
CPP_HEAD = re.compile(
    r"\)\s*(?:(?:const|volatile|noexcept|override|final|mutable|&&?|try|SY_NOEXCEPT)\s*)*"
    r"(?:$|->|requires\b|:(?!:))")
RUST_HEAD = re.compile(r"\bfn\s+\w+")
LABEL = re.compile(r"\s*(?:public|private|protected)\s*:(?!:)")
NAME = re.compile(r"([~\w:]+|operator\s*[^\s(]+)\s*\(")


def blank(text):
    """The text with comments, literals and directives as spaces, its lines unmoved."""
    return BLANKED.sub(lambda m: re.sub(r"[^\n]", " ", m[0]), text)


def opens_function(head, suffix):
    if suffix == ".rs":
        return bool(RUST_HEAD.search(head))
    return bool(CPP_HEAD.search(head))


def name_of(head, suffix):
    if suffix == ".rs":
        return RUST_HEAD.search(head)[0].split()[-1]
    found = NAME.search(head)
    return found[1] if found else "without a name"


def functions(text, suffix=".cpp"):
    """Yields (name, line of the head, lines) for each function, outermost ones only."""
    plain = blank(text)
    stack, start, inside = [], 0, None
    for found in re.finditer(r"[{};]", plain):
        if found[0] == "{":
            label = LABEL.match(plain, start, found.start())
            start = label.end() if label else start
            head = plain[start:found.start()]
            if inside is None and opens_function(head, suffix):
                first = start + len(head) - len(head.lstrip())
                inside = (len(stack), name_of(head, suffix), plain.count("\n", 0, first) + 1)
            stack.append(found.start())
        elif found[0] == "}" and stack:
            stack.pop()
            if inside is not None and len(stack) == inside[0]:
                last = plain.count("\n", 0, found.start()) + 1
                yield inside[1], inside[2], last - inside[2] + 1
                inside = None
        start = found.end()
