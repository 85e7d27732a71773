import pathlib
import tempfile
import unittest

import tree_rules


class TreeRules(unittest.TestCase):
    def complaints(self, name, text):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / name).parent.mkdir(parents=True, exist_ok=True)
            (root / name).write_text(text)
            return list(tree_rules.complaints(root))

    def test_a_plain_tree_is_accepted(self):
        self.assertEqual(self.complaints("vigil/core/field/a.hpp", "#pragma once\n"), [])

    def test_500_lines_are_accepted_and_501_are_refused(self):
        self.assertEqual(self.complaints("a.cpp", "\n" * 500), [])
        self.assertEqual(len(self.complaints("a.cpp", "\n" * 501)), 1)

    def test_unfinished_work_is_refused(self):
        for word in ("TODO", "FIXME", "XXX"):
            self.assertEqual(len(self.complaints("a.cpp", f"// {word} later\n")), 1, word)

    def test_a_path_of_one_machine_is_refused_and_a_web_address_is_not(self):
        for root in ("work", "root", "home"):
            line = f'open("/{root}/there/a")'
            self.assertEqual(len(self.complaints("a.py", line)), 1, line)
        self.assertEqual(self.complaints("a.md", "https://example.org/home/page\n"), [])

    def test_vague_names_are_refused(self):
        for name in ("vigil/utils/a.cpp", "vigil/swarm/helpers.cpp", "vigil/swarm/fleet_manager.py"):
            self.assertEqual(len(self.complaints(name, "")), 1, name)

    def test_a_header_without_a_guard_is_refused(self):
        self.assertEqual(len(self.complaints("a.hpp", "")), 1)

    def test_seeds_of_fuzzers_may_be_any_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            seed = pathlib.Path(folder) / "fuzz" / "corpus" / "a_fuzzer" / "seed"
            seed.parent.mkdir(parents=True)
            seed.write_bytes(b"\xc0\x00")
            self.assertEqual(list(tree_rules.complaints(pathlib.Path(folder))), [])

    def test_a_test_that_nothing_builds_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            (root / "a_test.cpp").write_text("")
            self.assertEqual(len(list(tree_rules.complaints(root))), 1)
            (root / "CMakeLists.txt").write_text("vigil_test(a SOURCES a_test.cpp)\n")
            self.assertEqual(list(tree_rules.complaints(root)), [])

    def test_an_empty_tree_is_refused(self):
        with tempfile.TemporaryDirectory() as folder:
            self.assertEqual(len(list(tree_rules.complaints(pathlib.Path(folder)))), 1)


if __name__ == "__main__":
    unittest.main()
