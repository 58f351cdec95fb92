#!/usr/bin/env python3
"""What tools/abi demands of a change, before 1.0 and from then on, is what docs/adding-to-your-build.md promises."""
# SPDX-License-Identifier: Apache-2.0
import importlib.machinery
import importlib.util
import pathlib
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools" / "abi"
LOADER = importlib.machinery.SourceFileLoader("abi", str(TOOL))
abi = importlib.util.module_from_spec(importlib.util.spec_from_loader("abi", LOADER))
LOADER.exec_module(abi)

WAS = ["liblamplight.so.1", "T lamp::f()", "lamp::S: 8 bytes, aligned to 4"]


class Promises(unittest.TestCase):
    def lacks(self, now, version=(1, 1, 0), top="Unreleased"):
        return abi.broken_promises(version, "1.0.0", top, WAS, now)

    def test_nothing_is_asked_where_nothing_changed(self):
        self.assertEqual(self.lacks(WAS, top="1.0.0"), [])

    def test_what_is_new_needs_the_changelog_alone(self):
        now = WAS + ["T lamp::g()"]
        self.assertEqual(self.lacks(now), [])
        self.assertIn("CHANGELOG.md", self.lacks(now, top="1.0.0")[0])

    def test_what_is_taken_away_or_changed_needs_a_new_soversion(self):
        for now in (WAS[:2], WAS[:2] + ["lamp::S: 12 bytes, aligned to 4"]):
            [lack] = self.lacks(now)
            self.assertIn("LAMPLIGHT_SOVERSION", lack)
            self.assertIn("lamp::S: 8 bytes", lack)
            self.assertEqual(self.lacks(["liblamplight.so.2"] + now[1:]), [])

    def test_before_version_1_all_may_change(self):
        self.assertEqual(self.lacks(WAS[:1], version=(0, 9, 0)), [])

    def test_before_the_first_release_nothing_was_promised(self):
        self.assertEqual(abi.broken_promises((1, 0, 0), "", "1.0.0", [], WAS), [])


unittest.main()
