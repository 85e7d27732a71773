import pathlib
import tempfile
import unittest

import dependencies


class Dependencies(unittest.TestCase):
    def complaints(self, packages, table):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (("setup/packages.txt", packages), ("docs/dependencies.md", table)):
                (root / name).parent.mkdir()
                (root / name).write_text(text)
            return list(dependencies.complaints(root))

    def test_the_same_packages_are_accepted(self):
        self.assertEqual(self.complaints("# list\ncmake build cmake it builds\n", "| `cmake` | build | x |\n"), [])

    def test_a_package_without_a_row_is_refused(self):
        self.assertEqual(len(self.complaints("cmake build cmake it builds\n", "")), 1)

    def test_a_row_without_a_package_is_refused(self):
        self.assertEqual(len(self.complaints("cmake build - x\n", "| `cmake` | build |\n| `boost` | build |\n")), 1)

    def test_another_group_is_refused(self):
        self.assertEqual(len(self.complaints("cmake build cmake it builds\n", "| `cmake` | test | x |\n")), 1)

    def test_an_empty_list_is_refused(self):
        self.assertEqual(len(self.complaints("", "")), 1)

    def npm_complaints(self, dependencies_of_page, table):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in (("web/package.json", dependencies_of_page), ("docs/dependencies.md", table)):
                (root / name).parent.mkdir()
                (root / name).write_text(text)
            return list(dependencies.npm_complaints(root))

    def test_npm_packages_as_documented_are_accepted(self):
        page = '{"dependencies": {"preact": "11.2.0"}, "devDependencies": {"vite": "6.4.6"}}'
        table = "| `preact` | page | 11.2.0 | x |\n| `vite` | tool | 6.4.6 | x |\n"
        self.assertEqual(self.npm_complaints(page, table), [])

    def test_another_version_group_or_a_missing_row_is_refused(self):
        page = '{"dependencies": {"preact": "11.2.0"}}'
        for table in ("", "| `preact` | page | 11.2.1 |\n", "| `preact` | tool | 11.2.0 |\n"):
            self.assertEqual(len(self.npm_complaints(page, table)), 1, table)

    def test_a_version_that_is_not_exact_is_refused(self):
        page = '{"dependencies": {"preact": "^11.2.0"}}'
        self.assertEqual(len(self.npm_complaints(page, "| `preact` | page | ^11.2.0 |\n")), 1)


if __name__ == "__main__":
    unittest.main()
