"""How a case of a cohort went, told from what its stages left: scripts/gather.py of the workflow."""

import json
import os
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
sys.path.insert(0, os.path.join(os.path.dirname(__file__), "../../resources/workflows/cohort/scripts"))
import gather  # noqa: E402

METHODS = ["kitaoka", "dla"]
CT = "/data/Müller/ct.nii.gz"
FAILED_SEGMENT = {"exit": 4, "seconds": 1.0}
KILLED = {"started": "2026-11-02T09:30:00+0100", "node": "n1"}


def write(text, path):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)


class Outcome(unittest.TestCase):
    """Of one case, "a", in a cohort's folder."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.addCleanup(os.chdir, os.getcwd())
        os.chdir(self.folder.name)

    def end(self, stage, ending, log=""):
        write(json.dumps(ending), f"logs/a/{stage}.exit")
        write(log, f"logs/a/{stage}.log")

    def finish(self, *stages, code=0):
        for stage in stages:
            self.end(stage, {"exit": code, "seconds": 1.0})
            text = json.dumps({"inputs": [{"path": CT}]}) if stage == "info" else "{}"
            write(text, gather.results("a", METHODS, True)[stage])

    def outcome(self, ct=CT):
        done = gather.finished("a", ct, METHODS, True)
        return gather.outcome("a", ct, done, METHODS, True)

    def test_nothing_ran(self):
        self.assertEqual(self.outcome(), ("not finished", "info", None, ""))

    def test_everything_is_there(self):
        self.finish(*gather.stages(METHODS, True))
        self.assertEqual(self.outcome(), ("done", "", None, ""))

    def test_a_check_that_does_not_hold_is_no_failure(self):
        self.finish(*gather.stages(METHODS, True), code=7)
        self.assertEqual(self.outcome()[0], "done")

    def test_an_end_without_its_result_is_not_done(self):
        self.finish(*gather.stages(METHODS, True))
        os.remove("cases/a/trees/dla.vtp")
        self.assertEqual(self.outcome(), ("not finished", "grow-dla", None, ""))

    def test_another_ct_of_that_name_begins_anew(self):
        self.finish(*gather.stages(METHODS, True))
        self.assertEqual(self.outcome("/data/other.nii.gz"), ("not finished", "info", None, ""))

    def test_a_failure_has_its_stage_code_and_reason_without_paths(self):
        self.finish("info", "import")
        log = f"pneuma: warning: thick slices\npneuma: '{CT}' has no lungs; see \"/data/x\"\nTraceback\n"
        self.end("segment", FAILED_SEGMENT, log)
        self.assertEqual(self.outcome(), ("failed", "segment", 4, "'the CT' has no lungs; see '...'"))

    def test_a_failure_that_says_nothing_has_the_meaning_of_its_code(self):
        self.finish("info", "import")
        self.end("segment", {"exit": 9})
        self.assertEqual(self.outcome(), ("failed", "segment", 9, "out of memory"))
        self.end("segment", {"exit": 137})
        self.assertEqual(self.outcome()[2:], (137, "killed"))

    def test_what_was_killed_with_its_job_tells_where_and_when_it_began(self):
        self.finish("info", "import")
        self.end("segment", KILLED)
        status, stage, code, why = self.outcome()
        self.assertEqual((status, stage, code), ("not finished", "segment", None))
        self.assertIn("started at 2026-11-02T09:30:00+0100 on n1", why)

    def test_what_was_stopped_is_not_finished(self):
        self.finish("info", "import")
        for code in (130, 143):
            self.end("segment", {"exit": code})
            self.assertEqual(self.outcome()[:3], ("not finished", "segment", code))

    def test_an_open_stage_hides_no_failure(self):
        self.finish("info", "import", "segment", "lobes", "grow-dla")
        self.end("grow-kitaoka", KILLED)
        self.end("measure-dla", {"exit": 6}, "pneuma: no room\n")
        self.assertEqual(self.outcome(), ("failed", "measure-dla", 6, "no room"))

    def test_an_end_of_before_is_not_told_while_what_it_needs_is_missing(self):
        self.finish("info")
        self.end("segment", FAILED_SEGMENT)
        self.assertEqual(self.outcome(), ("not finished", "import", None, ""))


class Anonymous(unittest.TestCase):
    def test_no_quoted_name_is_left(self):
        for quoted in ("'DOE_JANE_0042.dcm'", '"DOE_JANE_0042.dcm"', "'O'Doe's CT.dcm'", "'/data/doe/a b' and 'x/DOE'", "\"DOE 'prone.dcm\" in 'x'"):
            sentence = gather.anonymous(f"the lung's slice {quoted} is damaged; get it anew", CT)
            self.assertEqual(sentence, "the lung's slice '...' is damaged; get it anew")
        self.assertNotIn("DOE", gather.anonymous(f"'{CT}/DOE.dcm' ends early", CT))

    def test_the_ct_and_options_stay(self):
        self.assertEqual(gather.anonymous(f"there is no file '{CT}'", CT), "there is no file 'the CT'")
        self.assertEqual(gather.anonymous(f'there is no file "{CT}"', CT), "there is no file 'the CT'")
        self.assertEqual(gather.anonymous("try '--repair'", CT), "try '--repair'")


class ToCheck(unittest.TestCase):
    dense = {"what": "dense parts", "value": 6.76, "low": 0.0, "high": 5.0, "unit": "%", "ok": False}

    def test_a_check_that_does_not_hold_is_a_sentence(self):
        self.assertEqual(gather.to_check({"lungs": {"checks": [self.dense]}}), ["lungs: dense parts is 6.76 % (low 0, high 5)"])
        self.assertEqual(gather.to_check({"lungs": {"checks": [self.dense | {"ok": True}]}}), [])

    def test_a_check_that_is_warned_of_is_told_once(self):
        warning = "dense parts: 6.8 %, outside 0.0 to 5.0 %; try --repair strong"
        self.assertEqual(gather.to_check({"lungs": {"checks": [self.dense], "warnings": [warning]}}), [f"lungs: {warning}"])

    def test_a_warning_of_something_else_hides_no_check(self):
        self.assertEqual(len(gather.to_check({"lungs": {"checks": [self.dense], "warnings": ["dense parts of the bed: 3"]}})), 2)
        self.assertEqual(len(gather.to_check({"lungs": {"checks": [self.dense]}, "lobes": {"warnings": ["dense parts: 1"]}})), 2)


if __name__ == "__main__":
    unittest.main()
