#!/usr/bin/env python3
"""Tests of check_layout.py: what it says of headers that were changed in forbidden ways.

    check_layout_test.py LAYOUT INCLUDE_FOLDER C_COMPILER
"""

import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).resolve().parent
LAYOUT, INCLUDE, COMPILER = sys.argv[1:4]


def said_of(old, new):
    """What the check says where `old` is replaced by `new` in abi.h."""
    with tempfile.TemporaryDirectory() as folder:
        changed = Path(folder) / "switchyard"
        changed.mkdir()
        for header in ("abi.h", "hints.h", "dynamics.h"):
            text = (Path(INCLUDE) / "switchyard" / header).read_text()
            if header == "abi.h":
                assert old in text, old
                text = text.replace(old, new, 1)
            (changed / header).write_text(text)
        run = subprocess.run([sys.executable, "-B", str(HERE / "check_layout.py"), LAYOUT, folder,
                              COMPILER, "-std=c99"], capture_output=True, text=True)
        return run.returncode, run.stdout + run.stderr


class CheckLayout(unittest.TestCase):
    def test_accepts_what_is_pinned(self):
        self.assertEqual(said_of("int32_t threads;", "int32_t threads;")[0], 0)

    def test_names_a_field_that_moved(self):
        code, text = said_of("double cutoff;", "double before; double cutoff;")
        self.assertEqual(code, 1)
        self.assertIn("field cutoff of record sy_control moved from 40 to 48", text)

    def test_names_a_field_that_is_gone(self):
        self.assertIn("field seed of record sy_control is gone",
                      said_of("uint64_t seed;", "uint64_t grain;")[1])

    def test_names_a_field_of_another_width(self):
        self.assertIn("field iterations of record sy_control grew from 8 to 16 bytes",
                      said_of("int64_t iterations;  /*", "int64_t iterations[2];  /*")[1])

    def test_asks_for_new_fields_to_be_pinned(self):
        self.assertIn("field more of record sy_wish is not pinned: append it to layout.txt",
                      said_of("int64_t instances; ", "int64_t more; int64_t instances; ")[1])

    def test_finds_padding_and_odd_sizes(self):
        self.assertIn("sy_cone has hidden padding", said_of("int32_t dim;", "")[1])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
