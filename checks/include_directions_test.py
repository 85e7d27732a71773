import pathlib
import tempfile
import unittest

import include_directions


class IncludeDirections(unittest.TestCase):
    def complaints(self, **files):
        """What the check says of a tree of these files: {"vigil/core/field/a.hpp": text}."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder)
            for name, text in files.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return list(include_directions.complaints(root))

    def assert_refused(self, name, line, *, beside=()):
        files = {name: line, **{other: "" for other in beside}}
        found = self.complaints(**files)
        self.assertEqual([c.split(": ")[0] for c in found], [f"{name}:1"], found)

    def assert_accepted(self, name, line, *, beside=()):
        self.assertEqual(self.complaints(**{name: line, **{other: "" for other in beside}}), [])

    def test_an_arrow_down_is_accepted(self):
        for name, target in (
            ("vigil/core/ergodic/a.cpp", "vigil/core/field/b.hpp"),
            ("vigil/core/field/a.cpp", "vigil/core/field/b.hpp"),
            ("vigil/swarm/a.cpp", "vigil/core/safety/b.hpp"),
            ("vigil/runtime/a.cpp", "vigil/swarm/b.hpp"),
            ("vigil/adapters/sim/a.cpp", "vigil/runtime/b.hpp"),
            ("vigil/adapters/console/a.cpp", "protocol/b.hpp"),
            ("vigil/apps/a.cpp", "vigil/adapters/sim/b.hpp"),
            ("vigil/core/field/a_test.cpp", "vigil/testing/b.hpp"),
            ("bench/a.cpp", "vigil/testing/b.hpp"),
        ):
            with self.subTest(f"{name} -> {target}"):
                self.assert_accepted(name, f'#include "{target}"\n', beside=[target])

    def test_an_arrow_up_or_across_is_refused(self):
        for name, target in (
            ("vigil/core/field/a.hpp", "vigil/core/ergodic/b.hpp"),
            ("vigil/core/ergodic/a.hpp", "vigil/core/safety/b.hpp"),
            ("vigil/core/safety/a.hpp", "vigil/core/dynamics/b.hpp"),
            ("vigil/core/dynamics/a.hpp", "vigil/swarm/b.hpp"),
            ("vigil/swarm/a.hpp", "vigil/runtime/b.hpp"),
            ("vigil/runtime/a.hpp", "vigil/adapters/sim/b.hpp"),
            ("vigil/adapters/sim/a.hpp", "vigil/adapters/recording/b.hpp"),
            ("vigil/adapters/sim/a.hpp", "vigil/apps/b.hpp"),
            ("vigil/apps/a.cpp", "vigil/testing/b.hpp"),
            ("vigil/core/field/a_test.cpp", "vigil/core/safety/b.hpp"),
            ("vigil/testing/a.hpp", "vigil/adapters/sim/b.hpp"),
        ):
            with self.subTest(f"{name} -> {target}"):
                self.assert_refused(name, f'#include "{target}"\n', beside=[target])

    def test_a_pure_room_includes_nothing_impure(self):
        for line in ("#include <thread>", "#include <fstream>", "#include <unistd.h>", "#include <sys/time.h>",
                     "#include <fmt/core.h>", "#  include <nlohmann/json.hpp>", "#include <random>"):
            for room in include_directions.PURE:
                with self.subTest(f"{room}: {line}"):
                    self.assert_refused(f"vigil/{room}/a.cpp", line)

    def test_a_pure_room_reads_no_clock_and_no_global_random_numbers(self):
        for line in ("auto t = std::chrono::steady_clock::now();", "std::random_device seed;", "int n = rand();"):
            with self.subTest(line):
                self.assert_refused("vigil/swarm/a.cpp", line)
        self.assert_accepted("vigil/swarm/a.cpp", "#include <chrono>\n// Not steady_clock: time comes in.\n")

    def test_a_pure_room_has_the_standard_library_and_Eigen(self):
        self.assert_accepted("vigil/core/field/a.hpp", "#include <Eigen/Core>\n#include <vector>\n#include <chrono>\n")

    def test_a_pure_room_has_the_processor_s_vector_instructions(self):
        self.assert_accepted("vigil/core/ergodic/a.cpp", "#include <immintrin.h>\n")

    def test_only_tests_have_test_libraries(self):
        self.assert_accepted("vigil/core/field/a_test.cpp", "#include <gtest/gtest.h>\n#include <rapidcheck/gtest.h>\n")
        self.assert_refused("vigil/runtime/a.cpp", "#include <gtest/gtest.h>\n")

    def test_an_include_of_nothing_or_not_from_the_root_is_refused(self):
        self.assert_refused("vigil/swarm/a.cpp", '#include "vigil/swarm/absent.hpp"\n')
        self.assert_refused("vigil/swarm/a.cpp", '#include "b.hpp"\n', beside=["vigil/swarm/b.hpp"])

    def test_a_file_outside_of_the_rooms_is_refused(self):
        self.assert_refused("vigil/elsewhere/a.cpp", "\n")

    def test_an_empty_tree_is_refused(self):
        self.assertEqual(len(self.complaints()), 1)


if __name__ == "__main__":
    unittest.main()
