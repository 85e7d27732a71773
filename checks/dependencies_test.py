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


if __name__ == "__main__":
    unittest.main()
