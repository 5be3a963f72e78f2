#!/usr/bin/env python3
"""Compares the code that a document quotes with the file it is from.

    quotes_test.py SOURCE DOCUMENT ...

A line `<!-- from examples/a.cpp -->` above a block says that the block stands in that file, word
for word; the file is compiled by another test. Links to files of the tree have to lead somewhere.
"""

import re
import sys
from pathlib import Path

QUOTE = re.compile(r"<!-- from (\S+) -->\n+```\w*\n(.*?)```", re.DOTALL)
CODE = re.compile(r"```.*?```|`[^`\n]*`", re.DOTALL)
LINK = re.compile(r"\]\((?!https?:|#)([^)#\s]+)")


def mistakes(source, document):
    text = (source / document).read_text()
    for name, block in QUOTE.findall(text):
        file = source / name
        if not file.is_file():
            yield f"{document}: quotes {name}, which does not exist"
        elif block not in file.read_text():
            yield f"{document}: the block from {name} is not in that file word for word"
    for place in LINK.findall(CODE.sub("", text)):
        if not (source / document).parent.joinpath(place).exists():
            yield f"{document}: links to {place}, which does not exist"


def main():
    source = Path(sys.argv[1])
    found = [sentence for document in sys.argv[2:] for sentence in mistakes(source, document)]
    print("\n".join(found) or "what the documents quote is what stands in the files")
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
