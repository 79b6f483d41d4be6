# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""Manual pages and completions hold every option of their program, and bash and man take them as they are."""
import gzip
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "config/debian"))
import bash_completion  # noqa: E402  pylint: disable=wrong-import-position
import help_text  # noqa: E402  pylint: disable=wrong-import-position
import man_page  # noqa: E402  pylint: disable=wrong-import-position

BUILD = pathlib.Path(os.environ.get("GRASPD_BUILD", HERE.parents[1] / "build"))
DOCUMENTS = BUILD / "config/debian"
PROGRAMS = [BUILD / "bin" / name for name in os.environ["GRASPD_PROGRAMS"].split()]
SAMPLE = """Does a thing. And another.
Usage: folder/sample [OPTIONS] files...

Positionals:
  files TEXT ... REQUIRED     what to read

Options:
  -h,--help                   Print this help message and exit
  --frames INT:NONNEGATIVE=0  two spaces before this text
  --frame2 INT:NONNEGATIVE=00 one space before this text
  -f,--format TEXT:{text,csv,json}=text
                              a long head
  --source TEXT Needs: --config
                              of a file
  --dry Excludes: --frames    a flag
  --.hidden-\\n                a flag that roff would take for a command

Ends well.
"""


def options_of(program):
    return [option for option in help_text.ask(program).options]


def complete(name, script, *words):
    """What bash offers for the last word."""
    quoted = " ".join(f"'{word}'" for word in words)
    command = (f'{script}\nCOMP_WORDS=({name} {quoted}) COMP_CWORD={len(words)}\n'
               f'_{name.replace("-", "_")}; printf "%s\\n" "${{COMPREPLY[@]}}"')
    return subprocess.run(["bash", "-c", command], stdout=subprocess.PIPE, text=True, check=True, cwd="/").stdout.split()


class Parsing(unittest.TestCase):
    def setUp(self):
        self.help = help_text.parse(SAMPLE)
        self.by_name = {option.names[-1]: option for option in self.help.options}

    def test_parts(self):
        self.assertEqual(self.help.description, "Does a thing. And another.")
        self.assertEqual(self.help.footer, "Ends well.")
        self.assertEqual(list(self.help.sections), ["Positionals", "Options"])
        self.assertEqual(self.help.sections["Positionals"][0].text, "what to read")

    def test_heads_of_every_length(self):
        self.assertEqual(self.by_name["--frames"].text, "two spaces before this text")
        self.assertEqual(self.by_name["--frame2"].text, "one space before this text")
        self.assertEqual(self.by_name["--format"].text, "a long head")
        self.assertEqual(self.by_name["--source"].text, "of a file")

    def test_values(self):
        self.assertEqual(self.by_name["--format"].choices, ["text", "csv", "json"])
        self.assertTrue(self.by_name["--source"].takes_file)
        self.assertTrue(self.by_name["--frames"].takes_value)
        self.assertFalse(self.by_name["--frames"].takes_file)
        self.assertFalse(self.by_name["--dry"].takes_value)

    def test_other_text_is_refused(self):
        for text in ("", "bash: no such file", "Usage: x\n\nOptions:\n"):
            with self.assertRaises(ValueError):
                help_text.parse(text)

    def test_page_escapes_what_roff_would_run(self):
        page = man_page.page("sample", "1", self.help)
        self.assertIn("\\fB\\-\\-.hidden\\-\\en\\fR", page)
        self.assertEqual([line for line in page.splitlines() if line.startswith("'")], [])

    def test_completion(self):
        script = bash_completion.script("sample", self.help)
        self.assertEqual(complete("sample", script, "--fo"), ["--format"])
        self.assertEqual(complete("sample", script, "--format", ""), ["text", "csv", "json"])
        self.assertEqual(complete("sample", script, "-f", "c"), ["csv"])
        self.assertEqual(complete("sample", script, "--frames", ""), [])
        self.assertIn("usr", complete("sample", script, "--source", "us"))
        self.assertIn("usr", complete("sample", script, "us"))


class Programs(unittest.TestCase):
    def test_there_are_some(self):
        self.assertGreaterEqual(len(PROGRAMS), 10)

    def test_every_option_is_in_page_and_completion(self):
        for program in PROGRAMS:
            page = gzip.decompress((DOCUMENTS / f"man/{program.name}.1.gz").read_bytes()).decode()
            script = (DOCUMENTS / f"completion/{program.name}").read_text(encoding="utf-8")
            names = [name for option in options_of(program) for name in option.names]
            self.assertIn("--help", names)
            self.assertIn("--version", names)
            offered = complete(program.name, script, "-")
            for name in names:
                self.assertIn(f"\\fB{man_page.roff(name)}\\fR", page, program)
                self.assertIn(name, offered, program)

    @unittest.skipIf(shutil.which("man") is None, "man is missing")
    def test_man_has_no_complaint(self):
        for program in PROGRAMS:
            page = DOCUMENTS / f"man/{program.name}.1.gz"
            result = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", "-Z", page], stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, text=True, check=False, env={**os.environ, "MANWIDTH": "80"})
            self.assertEqual((result.returncode, result.stderr), (0, ""), program)


if __name__ == "__main__":
    unittest.main(verbosity=2)
