# SPDX-FileCopyrightText: 2026 The graspd authors
# SPDX-License-Identifier: BSD-3-Clause
"""The layering test must be able to fail: every kind of violation, planted, is found; what is allowed is not."""
import pathlib
import tempfile
import unittest

import layering
import links
from cpp_functions import long_blocks

LICENCE = "// SPDX-FileCopyrightText: 2026 The graspd authors\n// SPDX-License-Identifier: BSD-3-Clause\n"


class Planted(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name).resolve()
        self.write("service/pipeline/point_cloud.hpp", LICENCE)
        self.write("service/pipeline/normals.hpp", LICENCE)
        self.write("service/runtime/mailbox.hpp", LICENCE)
        self.write("service/daemon/daemon.hpp", LICENCE)
        self.write("client/common/handle_csv.hpp", LICENCE)
        self.write("tests/support/scenes.hpp", LICENCE)

    def write(self, name, text):
        path = self.root / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")

    def found(self):
        return layering.problems(self.root)[1]

    def assert_refused(self, name, include, words):
        self.write(name, LICENCE + f"#include {include}\n")
        found = self.found()
        self.assertEqual(len(found), 1, (name, include, found))
        self.assertTrue(found[0].startswith(f"{name}:3: "), found[0])
        self.assertIn(words, found[0])

    def assert_allowed(self, name, include):
        self.write(name, LICENCE + f"#include {include}\n")
        self.assertEqual(self.found(), [])

    def test_a_clean_tree_is_clean(self):
        self.assertEqual(self.found(), [])

    def test_forbidden_own_includes(self):
        cases = [
            ("service/pipeline/a.cpp", '"service/runtime/mailbox.hpp"', "service/runtime"),
            ("service/pipeline/a.cpp", '"lcmtypes/graspd/handle_t.h"', "lcmtypes"),
            ("service/pipeline/a.cpp", '"../runtime/mailbox.hpp"', "service/runtime"),
            ("service/runtime/a.cpp", '"service/pipeline/point_cloud.hpp"', "service/pipeline"),
            ("service/runtime/a.cpp", "<graspd/status_t.hpp>", "lcmtypes"),
            ("service/transport/a.cpp", '"service/pipeline/normals.hpp"', "service/pipeline"),
            ("service/transport/a.cpp", '"service/runtime/mailbox.hpp"', "service/runtime"),
            ("service/config/a.cpp", '"service/daemon/daemon.hpp"', "service/daemon"),
            ("service/config/a.cpp", '"service/transport/lcm_bus.hpp"', "service/transport"),
            ("service/daemon/a.cpp", '"client/common/handle_csv.hpp"', "client"),
            ("service/daemon/a.cpp", '"tests/support/scenes.hpp"', "tests"),
            ("client/a.cpp", '"service/runtime/mailbox.hpp"', "service/runtime"),
            ("client/a.cpp", '"service/daemon/daemon.hpp"', "service/daemon"),
            ("client/a.cpp", '"tests/support/scenes.hpp"', "tests"),
        ]
        for name, include, words in cases:
            with self.subTest(name=name, include=include):
                self.assert_refused(name, include, words)
                (self.root / name).unlink()

    def test_forbidden_libraries(self):
        cases = [
            ("service/pipeline/a.cpp", "<lcm/lcm.h>", "LCM"),
            ("service/pipeline/a.cpp", "<yaml-cpp/yaml.h>", "yaml-cpp"),
            ("service/pipeline/a.cpp", "<spdlog/spdlog.h>", "spdlog"),
            ("service/pipeline/a.hpp", "<pcl/point_cloud.h>", "PCL"),
            ("client/a.hpp", "<pcl/io/pcd_io.h>", "PCL"),
            ("service/pipeline/a.cpp", "<chrono>", "pure"),
            ("service/pipeline/a.cpp", "<fstream>", "pure"),
            ("service/daemon/a.cpp", "<yaml-cpp/yaml.h>", "yaml-cpp"),
            ("service/daemon/a.cpp", "<lcm/lcm.h>", "LCM"),
            ("service/runtime/a.cpp", "<Eigen/Core>", "Eigen"),
            ("service/transport/a.cpp", "<gtest/gtest.h>", "test library"),
        ]
        for name, include, words in cases:
            with self.subTest(name=name, include=include):
                self.assert_refused(name, include, words)
                (self.root / name).unlink()

    def test_allowed_includes(self):
        self.assert_allowed("service/pipeline/a.cpp", "<pcl/point_cloud.h>")
        self.assert_allowed("service/pipeline/b.cpp", '"service/pipeline/normals.hpp"')
        self.assert_allowed("service/transport/a.cpp", '"service/pipeline/point_cloud.hpp"')
        self.assert_allowed("service/transport/b.cpp", "<lcm/lcm.h>")
        self.assert_allowed("service/config/a.cpp", "<yaml-cpp/yaml.h>")
        self.assert_allowed("service/daemon/a.cpp", '"service/runtime/mailbox.hpp"')
        self.assert_allowed("tests/unit/daemon/a.cpp", '"service/daemon/daemon.hpp"')

    def test_includes_in_words_do_not_count(self):
        self.write("service/runtime/a.cpp", LICENCE + '// #include "service/pipeline/point_cloud.hpp"\n')
        self.assertEqual(self.found(), [])

    def test_licence_lines(self):
        for name in ("service/runtime/a.hpp", "tests/a.py", "client/CMakeLists.txt", "run", "config/a.yaml"):
            self.write(name, "\n")
            self.assertEqual(len(self.found()), 2, name)
            (self.root / name).unlink()

    def test_long_file(self):
        self.write("service/runtime/a.cpp", LICENCE + "\n" * (layering.MAX_FILE_LINES - 1))
        self.assertEqual(len(self.found()), 1)

    def test_long_functions(self):
        body = "  f();\n" * layering.MAX_FUNCTION_LINES
        for text in (f"void g() {{\n{body}}}\n", f"namespace a {{\nstruct B {{\nvoid g() {{\n{body}}}\n}};\n}}\n",
                     f"TEST(A, B) {{\n{body}}}\n", f"A::A() : a_{{1}}, b_{{2}} {{\n{body}}}\n",
                     f"template <class T>\nvoid g(std::vector<struct T> t) {{\n{body}}}\n"):
            self.write("service/runtime/a.cpp", LICENCE + text)
            self.assertEqual(len(self.found()), 1, text[:40])
        (self.root / "service/runtime/a.cpp").unlink()
        self.write("tests/a.py", LICENCE.replace("//", "#") + "def g():\n" + "    f()\n" * layering.MAX_FUNCTION_LINES)
        self.assertEqual(len(self.found()), 1)

    def test_what_is_no_long_function(self):
        many = "".join(f"void f{i}() {{\n  g();\n}}\n" for i in range(40))
        self.assertEqual(long_blocks("namespace a {\n" + many + "}\n", 60), [])
        self.assertEqual(long_blocks("struct A {\n" + many + "};\n", 60), [])
        braces = 'void f() { g("{", \'{\', 1\'000); }  // {\n/* { */\n#define X {\n' + 'auto r = R"x(\n{{{)x";\n'
        self.assertEqual(long_blocks(braces + many, 60), [])

    def test_broken_links_are_found(self):
        self.write("README.md", "# A title, `with` code\n[a](service/README.md) [b](#a-title-with-code) [c](https://a.b/c)\n"
                   "```\n[not a link](nowhere.md)\n```\n[d](service/README.md#there)")
        self.write("service/README.md", "## There\n[up](../README.md) [folder](pipeline)\n")
        self.write("build/README.md", "[generated](nowhere.md)")
        self.assertEqual(list(links.broken_links(self.root)), [])
        self.write("tests/README.md", "[gone](gone.md) [no heading](../README.md#there) [own](#none)\n")
        self.assertEqual([link for _, link, _ in links.broken_links(self.root)], ["gone.md", "../README.md#there", "#none"])

    def test_an_empty_tree_is_no_success(self):
        with tempfile.TemporaryDirectory() as empty:
            self.assertEqual(layering.main([empty]), 1)


if __name__ == "__main__":
    unittest.main()
